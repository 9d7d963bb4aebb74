// Which nodes draw which frames, decided once before a rendering: the frames asked for, cut into tasks of one interval
// each, and the machine's nodes, cut into groups. Each group takes one task after another, whichever is next; within
// its group a task determines which nodes draw which frame (wire::team_of_inbetween).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hal/collectives/group.h"
#include "node/wire/film.h"
#include "node/wire/protocol.h"

namespace mars::farm {

// Frames of one interval for one group: the first is the keyframe, drawn by all its nodes. Several tasks may be of one
// interval.
struct Task {
  std::uint32_t interval;
  std::vector<std::uint32_t> frames;  // ascending
  std::uint64_t first_inbetween;      // inbetweens in all tasks before: turns go over the whole film
};

// Some of a task's inbetweens, that are given to its group together; the first such portion has the keyframe, too.
struct Portion {
  std::size_t first = 0;  // among the task's inbetweens
  std::size_t count = 0;
  std::vector<std::int32_t> cycle{};  // of the teams that draw them (wire::Render); empty: in turns
};

// All of a task at once, in turns.
Portion whole(const Task& task);

// Given to a group at a time, so that it never waits for the host.
inline constexpr std::size_t kTasksAhead = 2;

// What is asked of a plan.
struct PlanRequest {
  std::vector<std::uint32_t> frames;  // ascending, within the film
  bool coherence = true;              // no: every frame is a task of its own
  std::uint32_t groups = 0;           // that work side by side; 0: see make_groups
  std::int32_t contributors = 0;      // as in Plan
  std::int32_t sharers = 1;           // as in Plan; 0: 1
  std::uint32_t most_frames = 0;      // of a task, as in make_tasks
};

// How the nodes of a group divide frames among them (wire::Render).
struct Division {
  std::int32_t contributors;
  std::int32_t teams = 0;
};

struct Plan {
  std::vector<Task> tasks;
  std::vector<collectives::Group> groups;
  std::int32_t contributors = 0;  // nodes of a group that draw its keyframes, at most; 0: all
  std::int32_t sharers = 1;       // nodes that draw an inbetween together, or a few more

  std::int32_t contributors_of(const collectives::Group& group) const;
  // One of all its nodes at least.
  std::int32_t teams_of(const collectives::Group& group) const;
  Division division_of(const collectives::Group& group) const { return {contributors_of(group), teams_of(group)}; }

  std::uint32_t keyframes() const { return static_cast<std::uint32_t>(tasks.size()); }
  std::uint32_t inbetweens() const;
  std::uint32_t frames() const { return keyframes() + inbetweens(); }
};

Plan make_plan(const wire::PackedFilm& film, const PlanRequest& request, int nodes);

// A portion of the task, or all of it, as a Render message: short where its frames follow each other.
std::vector<std::byte> render_command(const Task& task, const Portion& portion, const collectives::Group& group,
                                      const Division& division);
std::vector<std::byte> render_command(const Task& task, const collectives::Group& group, const Division& division);

// A task for each interval; or, where it has more than `most_frames`, several of about as many frames. 0: one.
std::vector<Task> make_tasks(const wire::PackedFilm& film, std::span<const std::uint32_t> frames, bool coherence,
                             std::uint32_t most_frames = 0);
// The same of tasks that were made.
std::vector<Task> cut_tasks(std::span<const Task> tasks, std::uint32_t most_frames);

// `nodes` nodes as `groups` groups of about equal size, side by side. 0 groups: one for every four tasks, so that what
// one task takes longer than another evens out; with fewer than eight tasks one group of all nodes, as in the thesis.
std::vector<collectives::Group> make_groups(int nodes, int groups, std::size_t tasks);

}  // namespace mars::farm
