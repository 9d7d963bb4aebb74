// Files of frames on simulated machines: work of processors, and bytes that go to storage.
#pragma once

#include "hal/simulated/world.h"
#include "host/images/picture_format.h"
#include "host/render/farm/farm.h"
#include "host/render/sinks/served_sinks.h"

namespace mars::programs {

// When a frame's file of the host is there whose sink begins now; the host is woken then.
sinks::ServedSinks::Serve serve_files(simulated::World& world, images::PictureFormat format);

// Of nodes whose writers only count (counted_writer.h): their orders say nothing.
farm::Writing counted_writing();

}  // namespace mars::programs
