#include "host/content/film/motion_writer.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <exception>
#include <limits>
#include <mutex>
#include <thread>

#include "hal/failure/failure.h"
#include "host/content/animator/pose/joint_frames.h"
#include "host/content/document/text.h"
#include "node/shape/dual_quaternion.h"
#include "topology/memory_limit.h"
#include "topology/processor_limit.h"

namespace mars::film {
namespace {

constexpr double kFarthestMatrix = 1e12;                        // as node/wire/film.h allows
constexpr std::size_t kWorthAThread = 20'000;                   // matrices
constexpr std::size_t kCapacityBehind = std::size_t{64} << 20;  // bytes; costs nothing until it is used
constexpr std::size_t kListedBytes = 3 * sizeof(wire::Change);  // of each, on the way
constexpr std::size_t kMatricesAtATime = (std::size_t{64} << 20) / sizeof(wire::Matrix);  // of a film in a file

// Frames at which something may differ from the frame before: (after, last], ascending and apart.
struct Run {
  std::uint32_t after, last;
};
using Runs = std::vector<Run>;

template <typename Value>
void add_runs(const animator::Channel<Value>& channel, std::uint32_t frames, Runs& runs) {
  for (std::size_t i = 0; i + 1 < channel.size() && channel[i].frame + 1 < frames; ++i) {
    if (!animator::moves_after(channel, i)) continue;
    const std::uint32_t next = channel[i + 1].frame;
    const Run run{channel[i].ease.hold ? next - 1 : channel[i].frame, std::min(next, frames - 1)};
    if (run.after < run.last) runs.push_back(run);
  }
}

Runs merged(Runs runs) {
  std::sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) { return a.after < b.after; });
  Runs apart;
  for (const Run& run : runs)
    if (!apart.empty() && run.after <= apart.back().last)
      apart.back().last = std::max(apart.back().last, run.last);
    else
      apart.push_back(run);
  return apart;
}

std::size_t count_of(const Runs& runs) {
  std::size_t frames = 1;  // the first frame has a matrix anyway
  for (const Run& run : runs) frames += run.last - run.after;
  return frames;
}

// What one actor may need at most, and where it is written.
struct Share {
  std::vector<wire::Track*> tracks;  // of its segments, each followed by those of its bones
  std::vector<std::size_t> most;     // matrices of each of them
  std::size_t first_matrix = 0, first_change = 0;
  std::size_t matrices = 0;            // written
  std::vector<std::uint32_t> changes;  // written, of each track
};

std::vector<std::size_t> most_of_matrices(const animator::Actor& actor, const modeler::Model& model,
                                          std::uint32_t frames) {
  std::vector<std::size_t> most;
  const auto add = [&](std::size_t joint) {
    const auto& keys = actor.matrices[joint];
    most.push_back(std::count_if(keys.begin(), keys.end(), [&](const auto& key) { return key.frame < frames; }));
  };
  for (std::size_t joint = 0; joint < model.joints.size(); ++joint) {
    if (!model.joints[joint].segment) continue;
    add(joint);
    for (const modeler::Bone& bone : model.joints[joint].segment->bones) add(bone.joint);
  }
  return most;
}

// What of runs of the whole film lies in the frames (within.after, within.last].
void add_clipped(const Runs& runs, const Run& within, Runs& clipped) {
  for (const Run& run : runs) {
    const Run part{std::max(run.after, within.after), std::min(run.last, within.last)};
    if (part.after < part.last) clipped.push_back(part);
  }
}

// Frames in `within` at which the whole actor may move: by its own keys, or with its carrier; and where what carries
// it changes. At no frame do actors carry each other in a circle, so this ends.
void add_root_runs(const animator::Film& film, std::size_t number, const Run& within, Runs& runs);

void add_joint_runs(const animator::Film& film, const animator::Attachment& carrier, const Run& within, Runs& runs) {
  add_root_runs(film, carrier.actor, within, runs);
  const animator::Actor& actor = film.actors[carrier.actor];
  const auto& joints = film.models[actor.model].joints;
  Runs turns;
  for (std::size_t joint = carrier.joint; joint != modeler::kNone; joint = joints[joint].parent)
    add_runs(actor.motion.pose[joint], film.frames, turns);
  add_clipped(turns, within, runs);
}

void add_root_runs(const animator::Film& film, std::size_t number, const Run& within, Runs& runs) {
  const animator::Actor& actor = film.actors[number];
  Runs own;
  add_runs(actor.motion.place, film.frames, own);
  add_runs(actor.motion.turn, film.frames, own);
  std::uint32_t after = within.after;
  for (std::size_t key = 0; key <= actor.attach.size(); ++key) {
    // Until the key's frame, what the key before says holds.
    const std::uint32_t next = key < actor.attach.size() ? actor.attach[key].frame : film.frames;
    if (const Run held{after, std::min(next == 0 ? 0 : next - 1, within.last)}; held.after < held.last) {
      const bool carried = key > 0 && actor.attach[key - 1].value;
      carried ? add_joint_runs(film, *actor.attach[key - 1].value, held, runs) : add_clipped(own, held, runs);
    }
    if (next > within.last) break;
    if (next > within.after) runs.push_back({next - 1, next});
    after = std::max(after, next);
  }
}

// A joint moves where it is turned or its parent moves.
std::vector<std::size_t> most_of_motion(const animator::Film& film, std::size_t number) {
  const animator::Actor& actor = film.actors[number];
  const modeler::Model& model = film.models[actor.model];
  const std::uint32_t frames = film.frames;
  Runs root;
  add_root_runs(film, number, {0, frames - 1}, root);
  root = merged(std::move(root));
  std::vector<Runs> runs(model.joints.size());
  std::vector<std::size_t> most;
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const modeler::Joint& joint = model.joints[i];
    runs[i] = joint.parent == modeler::kNone ? root : runs[joint.parent];
    const std::size_t before = runs[i].size();
    add_runs(actor.motion.pose[i], frames, runs[i]);
    if (runs[i].size() > before) runs[i] = merged(std::move(runs[i]));
  }
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const modeler::Joint& joint = model.joints[i];
    if (!joint.segment) continue;
    most.push_back(count_of(runs[i]));
    for (const modeler::Bone& bone : joint.segment->bones) most.push_back(count_of(runs[bone.joint]));
  }
  return most;
}

class MotionWriter {
 public:
  MotionWriter(const animator::Film& film, wire::FilmData& data, CompiledFilm::Lines& lines)
      : film_(film), data_(data), lines_(lines) {}

  std::size_t write() {
    plan();
    refuse_too_many();
    matrices_ = reserve(most_matrices_);
    refuse_too_many();                                     // there may be no file for them
    const std::size_t own_changes = data_.changes.size();  // of camera, lights and materials
    data_.changes.resize(own_changes + most_matrices_);
    for (Share& share : shares_) share.first_change += own_changes;
    play_all();
    const std::size_t matrices = close_gaps(own_changes);
    lines_.resize(lines_of(matrices));
    let_pages_go(lines_);
    return matrices;
  }

 private:
  static std::size_t lines_of(std::size_t matrices) {
    return (wire::kMatricesOffset + matrices * sizeof(wire::Matrix) + sizeof(CompiledFilm::Line) - 1) /
           sizeof(CompiledFilm::Line);
  }

  wire::Matrix* reserve(std::size_t matrices) {
    // Capacity for what follows them, mostly their changes, so that they need not be moved again.
    lines_.reserve(lines_of(matrices + matrices / 4) + kCapacityBehind / sizeof(CompiledFilm::Line));
    lines_.resize(lines_of(matrices));
    return reinterpret_cast<wire::Matrix*>(reinterpret_cast<std::byte*>(lines_.data()) + wire::kMatricesOffset);
  }

  void plan() {
    wire::Segment* segment = data_.segments.data();
    for (std::size_t number = 0; number < film_.actors.size(); ++number) {
      const animator::Actor& actor = film_.actors[number];
      Share share;
      for (const modeler::Joint& joint : film_.models[actor.model].joints)
        if (joint.segment) add_tracks(*segment++, share);
      share.first_matrix = share.first_change = most_matrices_;
      share.most = actor.matrices.empty() ? most_of_motion(film_, number)
                                          : most_of_matrices(actor, film_.models[actor.model], film_.frames);
      check(share.most.size() == share.tracks.size(), "each of an actor's tracks was planned");
      for (const std::size_t most : share.most) most_matrices_ += most;
      shares_.push_back(std::move(share));
    }
  }

  void add_tracks(wire::Segment& segment, Share& share) {
    share.tracks.push_back(&segment.motion);
    for (std::uint32_t i = 0; i < segment.bone_count; ++i) share.tracks.push_back(&data_.bones[segment.first_bone + i]);
  }

  void refuse_too_many() const {
    const std::size_t bytes_each = kListedBytes + (lines_.get_allocator().in_file ? 0 : sizeof(wire::Matrix));
    const std::uint64_t needed = most_matrices_ * bytes_each, here = topology::usable_memory();
    const std::uint64_t most = std::numeric_limits<std::uint32_t>::max() - data_.changes.size();
    if (needed <= here && most_matrices_ <= most) return;
    throw Failure("moves so much that it needs " + std::to_string(most_matrices_) + " T-matrices, " +
                      topology::gigabytes(needed) + " of memory" +
                      (needed > here ? ", where there are " + topology::gigabytes(here) : ""),
                  film_.source.empty() ? "actors" : film_.source + ": actors",
                  "make the film shorter, or move fewer segments at a time");
  }

  // Threads take actors in order, so that of several failures the first actor's is known.
  void play_all() {
    std::atomic<std::size_t> next = 0, failed = shares_.size();
    std::exception_ptr failure;
    std::mutex guard;
    const auto work = [&] {
      for (std::size_t actor; (actor = next++) < failed;) {
        try {
          write_actor(actor);
        } catch (...) {
          const std::lock_guard lock(guard);
          if (actor >= failed) continue;
          failed = actor;
          failure = std::current_exception();
        }
      }
    };
    const std::size_t useful = std::min(shares_.size(), most_matrices_ / kWorthAThread);
    std::vector<std::jthread> helpers;
    for (std::size_t i = 1; i < std::min<std::size_t>(useful, topology::usable_processors()); ++i)
      helpers.emplace_back(work);
    work();
    helpers.clear();
    if (failure) std::rethrow_exception(failure);
  }

  // One track of an actor being written: the joint whose segment it moves, and its matrices so far.
  struct Writing {
    std::size_t joint;
    const modeler::Bone* bone;  // of that segment's skin; nullptr: it is the segment's own
    std::size_t number;         // in the actor's share
    wire::Change* changes;
    std::uint32_t count = 0;

    std::size_t moved_by() const { return bone != nullptr ? bone->joint : joint; }
  };

  void write_actor(std::size_t number) {
    Share& share = shares_[number];
    const animator::Actor& actor = film_.actors[number];
    std::vector<Writing> writings;
    const auto& joints = film_.models[actor.model].joints;
    wire::Change* changes = data_.changes.data() + share.first_change;
    const auto add = [&](std::size_t joint, const modeler::Bone* bone) {
      writings.push_back({joint, bone, writings.size(), changes});
      changes += share.most[writings.size() - 1];
    };
    for (std::size_t joint = 0; joint < joints.size(); ++joint) {
      if (!joints[joint].segment) continue;
      add(joint, nullptr);
      for (const modeler::Bone& bone : joints[joint].segment->bones) add(joint, &bone);
    }
    actor.matrices.empty() ? play(number, share, writings) : copy(number, share, writings);
    for (const Writing& writing : writings) share.changes.push_back(writing.count);
  }

  void play(std::size_t number, Share& share, std::vector<Writing>& writings) {
    const animator::Actor& actor = film_.actors[number];
    const modeler::Model& model = film_.models[actor.model];
    animator::Figure figure(model, actor.motion);
    animator::JointFrames carriers(film_);
    const bool carried = !actor.attach.empty();
    const std::uint32_t frames = figure.still() && !carried ? 1 : film_.frames;
    for (std::uint32_t frame = 0; frame < frames; ++frame) {
      if (!(carried ? figure.move_to(frame, carriers.root_of(number, frame)) : figure.move_to(frame))) continue;
      for (Writing& writing : writings) {
        if (!figure.moved(writing.moved_by())) continue;
        const modeler::Joint& joint = model.joints[writing.joint];
        const modeler::Axes& stands = figure.frame_of(writing.moved_by());
        add(number, share, writing, frame,
            writing.bone != nullptr ? modeler::bone_matrix(stands, *writing.bone, joint)
                                    : modeler::t_matrix(modeler::segment_frame(stands, joint), joint.segment->sbb));
      }
    }
  }

  void copy(std::size_t number, Share& share, std::vector<Writing>& writings) {
    const animator::Actor& actor = film_.actors[number];
    const auto& joints = film_.models[actor.model].joints;
    for (Writing& writing : writings) {
      const modeler::Joint &joint = joints[writing.joint], &moved_by = joints[writing.moved_by()];
      for (const animator::Key<modeler::Axes>& key : actor.matrices[writing.moved_by()]) {
        if (key.frame >= film_.frames) continue;
        const wire::Matrix matrix =
            writing.bone != nullptr
                ? modeler::bone_matrix(modeler::joint_frame(key.value, moved_by), *writing.bone, joint)
                : modeler::t_matrix(key.value, joint.segment->sbb);
        add(number, share, writing, key.frame, matrix);
      }
    }
  }

  void add(std::size_t actor, Share& share, Writing& writing, std::uint32_t frame, const wire::Matrix& matrix) {
    if (writing.count > 0 && matrix == matrices_[writing.changes[writing.count - 1].value]) return;
    check_near(matrix, film_, actor, writing.joint, frame);
    if (writing.bone != nullptr) check_volume(matrix, film_, actor, writing.joint, *writing.bone, frame);
    check(writing.count < share.most[writing.number], "a segment moves as often as was planned");
    const std::size_t place = share.first_matrix + share.matrices++;
    matrices_[place] = matrix;
    if (place % kMatricesAtATime == 0) let_pages_go(lines_);
    writing.changes[writing.count++] = {frame, static_cast<std::uint32_t>(place)};
  }

  // Fewer matrices than planned leave gaps. Moves all down over them; segments learn where their changes are.
  std::size_t close_gaps(std::size_t change_to) {
    std::size_t matrix_to = 0;
    for (const Share& share : shares_) {
      const std::size_t down = share.first_matrix - matrix_to;
      if (down > 0)
        std::memmove(static_cast<void*>(matrices_ + matrix_to), matrices_ + share.first_matrix,
                     share.matrices * sizeof(wire::Matrix));
      if (down > 0 && matrix_to / kMatricesAtATime != (matrix_to + share.matrices) / kMatricesAtATime)
        let_pages_go(lines_);
      std::size_t from = share.first_change;
      for (std::size_t i = 0; i < share.tracks.size(); ++i) {
        const std::uint32_t count = share.changes[i];
        for (std::uint32_t k = 0; k < count && (down > 0 || from != change_to); ++k) {
          const wire::Change& change = data_.changes[from + k];
          data_.changes[change_to + k] = {change.frame, static_cast<std::uint32_t>(change.value - down)};
        }
        *share.tracks[i] = {static_cast<std::uint32_t>(change_to), count};
        change_to += count;
        from += share.most[i];
      }
      matrix_to += share.matrices;
    }
    data_.changes.resize(change_to);
    return matrix_to;
  }

  const animator::Film& film_;
  wire::FilmData& data_;
  CompiledFilm::Lines& lines_;
  std::vector<Share> shares_;
  std::size_t most_matrices_ = 0;
  wire::Matrix* matrices_ = nullptr;
};

std::string place_of(const animator::Film& film, std::size_t actor, std::size_t joint, std::uint32_t frame) {
  return (film.source.empty() ? "" : film.source + ": ") + film.actors[actor].name + "/" +
         film.model_of(actor).joints[joint].name + ", frame " + std::to_string(frame);
}

}  // namespace

void check_near(const wire::Matrix& matrix, const animator::Film& film, std::size_t actor, std::size_t joint,
                std::uint32_t frame) {
  for (const auto& row : matrix.m)
    for (const double number : row)
      if (!(std::abs(number) <= kFarthestMatrix))
        throw Failure("stands farther than 1e12 from the origin", place_of(film, actor, joint, frame),
                      "use smaller places and boxes");
}

void check_volume(const wire::Matrix& matrix, const animator::Film& film, std::size_t actor, std::size_t joint,
                  const modeler::Bone& bone, std::uint32_t frame) {
  const auto& joints = film.model_of(actor).joints;
  if (joints[joint].segment->blend == wire::Blend::linear || !shape::is_flat(matrix)) return;
  throw Failure("has a skin whose bone '" + joints[bone.joint].name +
                    "' flattens what follows it, which dual quaternions cannot turn",
                place_of(film, actor, joint, frame),
                "give the bone's matrix three directions, or write \"blend\": \"linear\" in the skin");
}

std::size_t write_motion(const animator::Film& film, wire::FilmData& data, CompiledFilm::Lines& lines) {
  return MotionWriter(film, data, lines).write();
}

}  // namespace mars::film
