// The batch systems that mars submit knows, as a table of their words.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace mars::batch {

// In its texts {nodes} is the number of machines, {tasks} of processes, {each} of processes on a machine, {time} the
// time limit as it was given, {minutes} and {seconds} the same in other units, {partition} a queue's name,
// {script} the script's file, {output} where the job prints, {more} a person's words, {jobs} numbers of jobs, {again}
// the words by which a job submits its script again, {timeout} what ends a program before the time limit. A line is
// left out where what it names is not known.
struct BatchSystem {
  using Words = std::vector<std::string>;

  // Columns that it does not print are below 0.
  struct Columns {
    char separator;  // a blank stands for one or several
    int id, state, time, restarts, machines, reason;
  };

  std::string name;
  Words programs;           // by which it is known where all of them are in the PATH
  std::string folder;       // beside the frames, for scripts and what jobs print
  std::string script_name;  // there
  std::string output;       // there, for each job
  Words options;            // lines that begin the script
  std::string setup;        // what follows, until `film` is to be run; "": as in cluster/slurm/render.sbatch
  Words submit;             // a program and its words
  Words again;              // how a job submits its script again; none: its setup says how the job is queued again
  Words list;
  int header;  // lines before the first job, of which the last is one of dashes
  Columns columns;
  std::vector<std::array<std::string, 2>> states;  // words for people in place of its own
  Words ended;                                     // its own states of jobs that have ended
  Words unknown;                                   // parts of what it says of jobs that it does not know any more
  Words cancel;
};

const std::vector<BatchSystem>& batch_systems();

// The first one whose programs are in `path`. Throws Failure where there is none.
BatchSystem batch_system_in(const std::string& path);

}  // namespace mars::batch
