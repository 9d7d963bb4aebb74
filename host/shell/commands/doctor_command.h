// `mars doctor`: whether films can be rendered here.
#pragma once

#include "host/shell/doctor/doctor.h"

namespace CLI {
class App;
}

namespace mars::commands {

// `defaults`: the options where the command line says nothing; `code` becomes the exit code where it is not 0.
void add_doctor(CLI::App& app, const doctor::DoctorOptions& defaults, int& code);

}  // namespace mars::commands
