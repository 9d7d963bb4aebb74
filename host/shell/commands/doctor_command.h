// `mars doctor`: whether films can be rendered here.
#pragma once

#include "host/cli/command.h"
#include "host/shell/doctor/doctor.h"

namespace mars::commands {

// `defaults`: the options where the command line says nothing; `code` becomes the exit code where it is not 0.
void add_doctor(cli::Command app, const doctor::DoctorOptions& defaults, int& code);

}  // namespace mars::commands
