// MARS as a competitor: the host's side of bench-ours-threads and bench-ours-mpi, which differ by their backend only.
#pragma once

#include <string>

namespace mars::bench {

// What "go" renders: one whole frame from scratch after another; or a render interval's inbetweens, as many as it
// has, whose keyframe is drawn before and not counted; or `film`: an interval from its keyframe's drawing until the
// file of its last frame is closed. `latency` obeys nothing: it renders the first interval and says "latency T", the
// milliseconds of all steps of one inbetween after each other, from its dicing to its frame.
enum class Course { whole, inbetween, film, latency };

// Throws std::runtime_error for another word.
Course course_of(const std::string& word);

// Runs the calling HAL process as the host and obeys as peer.h says. `folder`: for the files of a film's frames.
void compete(const std::string& film, Course course, const std::string& backend, const std::string& folder);

}  // namespace mars::bench
