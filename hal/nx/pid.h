// The pid of a C program: what the host gave itself by setpid, 0 on nodes.
#pragma once

namespace mars::nx {

inline long own_pid = 0;

}  // namespace mars::nx
