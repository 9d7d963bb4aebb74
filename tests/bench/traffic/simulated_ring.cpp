// How what inbetweens need of stationary parts comes to all machines of a group, on nodes that smpirun simulates, each
// a machine: bench-simulated-ring.so LIST, of which each line is a node and the bytes that it has. Printed for each
// way: what a node sends, mean and greatest, and milliseconds from when all begin until the last has all. Computing
// takes no time. The ways:
//   to each   each node sends all that it has to every other one
//   ring      as node/group/relay.h: pieces go from node to node, once round
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <numeric>
#include <utility>
#include <vector>

#include <mpi.h>

namespace {

constexpr std::size_t kPiece = std::size_t{64} << 10;  // wire::kRelayPiece
constexpr std::size_t kAwaiting = 4;                   // pieces for which receives are posted

class Node {
 public:
  explicit Node(const char* list);

  void send_to_each();
  void send_round();

  int rank() const { return rank_; }
  int nodes() const { return nodes_; }
  double take_sent() { return std::exchange(sent_, 0.0); }

 private:
  std::size_t of(int node) const { return bytes_[static_cast<std::size_t>(node)]; }
  void start(int to, std::size_t length, int owner);
  void forward(std::size_t length, int owner);
  void finish();

  int rank_ = 0;
  int nodes_ = 0;
  std::vector<std::size_t> bytes_;  // by node
  std::vector<char> buffer_;        // nobody reads what is sent
  std::vector<char> received_;
  std::vector<MPI_Request> requests_;
  double sent_ = 0;
};

Node::Node(const char* list) {
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &nodes_);
  bytes_.resize(static_cast<std::size_t>(nodes_));
  std::ifstream file(list);
  std::size_t node = 0, bytes = 0;
  while (file >> node >> bytes)
    if (node < bytes_.size()) bytes_[node] = bytes;
  const std::size_t most = *std::ranges::max_element(bytes_);
  buffer_.resize(std::max(most, kPiece));
  received_.resize(buffer_.size());
}

// The tag is the piece's owner.
void Node::start(int to, std::size_t length, int owner) {
  requests_.emplace_back();
  MPI_Isend(buffer_.data(), static_cast<int>(length), MPI_BYTE, to, owner, MPI_COMM_WORLD, &requests_.back());
  sent_ += static_cast<double>(length);
}

void Node::finish() {
  MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
  requests_.clear();
}

void Node::send_to_each() {
  for (int from = 0; from < nodes_; ++from) {
    if (from == rank_ || of(from) == 0) continue;
    requests_.emplace_back();
    MPI_Irecv(received_.data(), static_cast<int>(of(from)), MPI_BYTE, from, from, MPI_COMM_WORLD, &requests_.back());
  }
  for (int to = 0; to < nodes_; ++to)
    if (to != rank_ && of(rank_) > 0) start(to, of(rank_), rank_);
  finish();
}

// A piece that has come goes on, unless the next node has made it.
void Node::forward(std::size_t length, int owner) {
  const int next = (rank_ + 1) % nodes_;
  if (next != owner) start(next, length, owner);
}

void Node::send_round() {
  const int before = (rank_ + nodes_ - 1) % nodes_, next = (rank_ + 1) % nodes_;
  std::size_t left = std::accumulate(bytes_.begin(), bytes_.end(), std::size_t{0}) - of(rank_), own = of(rank_);
  std::vector<MPI_Request> posted(kAwaiting, MPI_REQUEST_NULL);
  const auto post = [&](MPI_Request& request) {
    MPI_Irecv(received_.data(), static_cast<int>(kPiece), MPI_BYTE, before, MPI_ANY_TAG, MPI_COMM_WORLD, &request);
  };
  for (MPI_Request& request : posted) post(request);
  const auto receive = [&](std::size_t& number, MPI_Status& status) {
    int length = 0;
    MPI_Get_count(&status, MPI_BYTE, &length);
    left -= static_cast<std::size_t>(length);
    forward(static_cast<std::size_t>(length), status.MPI_TAG);
    post(posted[number % kAwaiting]);
    ++number;
  };
  MPI_Status status;
  for (std::size_t number = 0; own > 0 || left > 0;) {
    if (own > 0) {
      const std::size_t piece = std::min(own, kPiece);
      start(next, piece, rank_);
      own -= piece;
    }
    int has_come = 0;
    if (left > 0 && own > 0)
      MPI_Test(&posted[number % kAwaiting], &has_come, &status);
    else if (left > 0)
      MPI_Wait(&posted[number % kAwaiting], &status), has_come = 1;
    if (has_come != 0) receive(number, status);
  }
  for (MPI_Request& request : posted) MPI_Cancel(&request), MPI_Request_free(&request);
  finish();
}

void measure(Node& node, const char* name, void (Node::*way)()) {
  MPI_Barrier(MPI_COMM_WORLD);
  const double begin = MPI_Wtime();
  (node.*way)();
  const std::array own{node.take_sent(), MPI_Wtime() - begin};
  std::array<double, 2> most{}, sum{};
  MPI_Reduce(own.data(), most.data(), 2, MPI_DOUBLE, MPI_MAX, 0, MPI_COMM_WORLD);
  MPI_Reduce(own.data(), sum.data(), 2, MPI_DOUBLE, MPI_SUM, 0, MPI_COMM_WORLD);
  if (node.rank() == 0)
    std::printf("%6d %-8s %9.1f %9.1f %10.2f\n", node.nodes(), name, sum[0] / node.nodes() / 1e6, most[0] / 1e6,
                1e3 * most[1]);
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  if (argc == 2) {
    Node node(argv[1]);
    if (node.rank() == 0) std::printf("%6s %-8s %9s %9s %10s\n", "nodes", "way", "MB", "most", "ms");
    measure(node, "to each", &Node::send_to_each);
    measure(node, "ring", &Node::send_round);
  }
  MPI_Finalize();
  return argc == 2 ? EXIT_SUCCESS : EXIT_FAILURE;
}
