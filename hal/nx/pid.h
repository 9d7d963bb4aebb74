// The pid of a C program: what the host gave itself by setpid, 0 on nodes.
#pragma once

namespace mars::hal {

inline long own_pid = 0;

}  // namespace mars::hal
