// A machine that another one's doctor asks: the side of round.h at the other end of ssh or srun.
#pragma once

#include <filesystem>

#include "host/shell/doctor/doctor.h"

namespace mars::doctor {

// Answers on standard output, and stays until standard input ends; a minute at most.
void answer_doctor(const DoctorOptions& options, const std::filesystem::path& self);

}  // namespace mars::doctor
