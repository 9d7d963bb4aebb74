// The exchange of triangles in one keyframe, as a list of bench-traffic counted it, on nodes that smpirun simulates:
// bench-simulated-exchange.so LIST. Printed for each route: what a node sends, mean and greatest, and microseconds from
// when all begin until the last has all. Computing takes no time. The routes:
//   listed    the messages of the list as they are
//   agreed    a reduction tells each node how many messages come; then one for each pair of nodes that has something
//   crystal   log2 P messages a node, one across each dimension of the hypercube, with all that has to cross it
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <mpi.h>

namespace {

constexpr std::size_t kHead = 16;  // bytes before those of a parcel that the crystal router forwards

struct Sent {
  double messages = 0;
  double bytes = 0;
};

struct Message {
  int node;  // receiver or sender
  std::size_t bytes;
};

class Node {
 public:
  explicit Node(const char* list);

  Sent listed();
  Sent agreed();
  Sent crystal();

  int rank() const { return rank_; }
  int nodes() const { return nodes_; }

 private:
  std::size_t& bytes(int from, int to) { return bytes_[static_cast<std::size_t>(from * nodes_ + to)]; }
  // What the crystal router carries across dimension `bit` from node `from`, the lower dimensions being crossed.
  std::size_t crossing(int from, int bit);
  // No longer than `longest_`, unless nothing else is on its way.
  void start(int to, std::size_t length);
  void receive(int from, std::size_t capacity);
  void post_receives();
  void finish();

  int rank_ = 0;
  int nodes_ = 0;  // a power of two
  std::vector<Message> out_, in_;
  std::vector<std::size_t> bytes_;  // by sender and receiver
  std::size_t longest_ = 0;         // of them
  std::vector<char> buffer_;
  std::vector<char> received_;
  std::vector<MPI_Request> requests_;
};

Node::Node(const char* list) {
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &nodes_);
  bytes_.resize(static_cast<std::size_t>(nodes_) * static_cast<std::size_t>(nodes_));
  std::ifstream file(list);
  int from = 0, to = 0;
  std::size_t messages = 0, empty = 0, sum = 0;
  for (std::string kind; file >> from >> to >> messages >> empty >> sum && std::getline(file, kind);) {
    if (kind != " triangles" && kind != " edge boxes") continue;
    bytes(from, to) += sum;
    if (from == rank_) out_.push_back({to, sum});
    if (to == rank_) in_.push_back({from, sum});
  }
  longest_ = *std::ranges::max_element(bytes_);
  buffer_.resize(longest_);
  received_.resize(longest_);
  const auto distance = [this](int node) { return (node - rank_ + nodes_) % nodes_; };
  std::ranges::stable_sort(out_, {}, [&](const Message& m) { return distance(m.node); });
  std::ranges::stable_sort(in_, {}, [&](const Message& m) { return nodes_ - distance(m.node); });
}

void Node::start(int to, std::size_t length) {
  buffer_.resize(std::max(buffer_.size(), length));
  requests_.emplace_back();
  MPI_Isend(buffer_.data(), static_cast<int>(length), MPI_BYTE, to, 1, MPI_COMM_WORLD, &requests_.back());
}

void Node::receive(int from, std::size_t capacity) {
  received_.resize(std::max(received_.size(), capacity));
  MPI_Recv(received_.data(), static_cast<int>(capacity), MPI_BYTE, from, 1, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
}

// Whatever comes first is taken first.
void Node::post_receives() {
  std::size_t sum = 0, offset = 0;
  for (int from = 0; from < nodes_; ++from) sum += bytes(from, rank_);
  received_.resize(std::max(received_.size(), sum));
  for (int from = 0; from < nodes_; ++from) {
    const std::size_t length = bytes(from, rank_);
    if (length == 0) continue;
    requests_.emplace_back();
    MPI_Irecv(received_.data() + std::exchange(offset, offset + length), static_cast<int>(length), MPI_BYTE, from, 1,
              MPI_COMM_WORLD, &requests_.back());
  }
}

void Node::finish() {
  MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
  requests_.clear();
}

Sent Node::listed() {
  Sent sent;
  for (const Message& message : out_) {
    start(message.node, message.bytes);
    sent = {sent.messages + 1, sent.bytes + static_cast<double>(message.bytes)};
  }
  for (const Message& message : in_) receive(message.node, message.bytes);
  finish();
  return sent;
}

Sent Node::agreed() {
  Sent sent;
  const auto count = [&](std::size_t length) { sent = {sent.messages + 1, sent.bytes + static_cast<double>(length)}; };
  for (int half = nodes_ / 2; half > 0; half /= 2) {
    const std::size_t length = static_cast<std::size_t>(half) * sizeof(int);
    start(rank_ ^ half, length);
    receive(rank_ ^ half, length);
    finish();
    count(length);
  }
  post_receives();
  for (int i = 1; i < nodes_; ++i) {
    const int to = (rank_ + i) % nodes_;
    if (bytes(rank_, to) == 0) continue;
    start(to, bytes(rank_, to));
    count(bytes(rank_, to));
  }
  finish();
  return sent;
}

std::size_t Node::crossing(int from, int bit) {
  const int low = bit - 1;
  std::size_t sum = 0;
  for (int sender = 0; sender < nodes_; ++sender) {
    if ((sender & ~low) != (from & ~low)) continue;
    for (int receiver = 0; receiver < nodes_; ++receiver)
      if ((receiver & low) == (from & low) && (receiver & bit) != (from & bit) && bytes(sender, receiver) > 0)
        sum += kHead + bytes(sender, receiver);
  }
  return sum;
}

Sent Node::crystal() {
  Sent sent;
  for (int bit = 1; bit < nodes_; bit <<= 1) {
    const int other = rank_ ^ bit;
    const std::size_t length = crossing(rank_, bit);
    start(other, length);
    receive(other, crossing(other, bit));
    sent = {sent.messages + 1, sent.bytes + static_cast<double>(length)};
    finish();
  }
  return sent;
}

void measure(Node& node, const char* name, Sent (Node::*route)()) {
  MPI_Barrier(MPI_COMM_WORLD);
  const double begin = MPI_Wtime();
  const Sent sent = (node.*route)();
  const double own[3] = {sent.messages, sent.bytes, MPI_Wtime() - begin};
  double most[3] = {}, sum[3] = {};
  MPI_Reduce(own, most, 3, MPI_DOUBLE, MPI_MAX, 0, MPI_COMM_WORLD);
  MPI_Reduce(own, sum, 3, MPI_DOUBLE, MPI_SUM, 0, MPI_COMM_WORLD);
  if (node.rank() == 0)
    std::printf("%6d %-8s %9.1f %6.0f %9.1f %8.1f %12.1f\n", node.nodes(), name, sum[0] / node.nodes(), most[0],
                sum[1] / node.nodes() / 1e3, most[1] / 1e3, 1e6 * most[2]);
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  if (argc == 2) {
    Node node(argv[1]);
    if (node.rank() == 0)
      std::printf("%6s %-8s %9s %6s %9s %8s %12s\n", "nodes", "route", "messages", "most", "kB", "most", "us");
    measure(node, "listed", &Node::listed);
    measure(node, "agreed", &Node::agreed);
    measure(node, "crystal", &Node::crystal);
  }
  MPI_Finalize();
  return argc == 2 ? EXIT_SUCCESS : EXIT_FAILURE;
}
