// Words that Open MPI's mpirun adds on standard error: blocks of help between lines of dashes, which are held back for
// the one line that a person needs, and remarks about such blocks. Lines that programs print go through, each as soon
// as it is whole.
#pragma once

#include <string>

namespace mars::nx_jobs {

class MpiHelp {
 public:
  // `has_host`: rank 0 is the host, else it is node 0.
  explicit MpiHelp(bool has_host) : has_host_(has_host) {}

  // The part of the text that is to be shown once this line, without its end, has come.
  std::string take(const std::string& line);
  // The rest, when nothing more comes: what happened, in a line; "" where the exit code says so, or the programs did.
  // Help that is not understood comes as mpirun wrote it.
  std::string finish() const;

 private:
  bool has_host_;
  bool is_within_ = false;
  std::string block_;  // that has begun
  std::string help_;   // all that was held back
};

// From now on, this process' standard error, and that of what it becomes, goes through MpiHelp to where it went before.
void explain_mpi_help(bool has_host);

}  // namespace mars::nx_jobs
