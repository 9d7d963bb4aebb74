// Small files of motions that are right in every number, and films made of motions.
#pragma once

#include <glm/vec3.hpp>
#include <string>

#include "host/content/animator/pose/joint_frames.h"
#include "host/content/animator/reading/read_film.h"
#include "tests/host/content/importer/import_folder.h"
#include "tests/host/content/importer/motions/plain_motions.h"

namespace mars::importer {

// Joints with all kinds of channels: each order of turns, two and one of them, none.
inline const std::string kBvh = R"(HIERARCHY
ROOT Hips
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT Spine
  {
    OFFSET 0 2 0.5
    CHANNELS 3 Zrotation Yrotation Xrotation
    JOINT Head
    {
      OFFSET 0 1.5 0
      CHANNELS 1 Yrotation
      End Site
      {
        OFFSET 0 1 0
      }
    }
  }
  JOINT LeftUpLeg
  {
    OFFSET 1 0 0
    CHANNELS 3 Xrotation Yrotation Zrotation
    JOINT LeftLeg {
      OFFSET 0.1 -3 0
      CHANNELS 2 Xrotation Zrotation
      JOINT LeftFoot
      {
        OFFSET 0 -3 0.2
        CHANNELS 0
        End Site
        {
          OFFSET 0 -0.2 1
        }
      }
    }
  }
}
MOTION
Frames: 4
Frame Time: 0.0333333
0 6 0    0 0 0        0 0 0      0    0 0 0       0 0
1 6.1 2  10 20 30     -40 50 10  70   15 -25 35   60 5
2 6 4    190 -80 170  100 85 -170 -120 -95 12 3   -10 -20
3 6.2 6  -300 10 0    5 90 7     179  1 89.5 -60  100 30
)";

inline const std::string kAsf = R"(:version 1.10
:name VICON
:units
  mass 1.0
  length 0.45
  angle deg
:documentation
   by hand
:root
   order TX TY TZ RX RY RZ
   axis XYZ
   position 0 0 0
   orientation 0 0 0
:bonedata
  begin
     id 1
     name back
     direction 0 1 0
     length 3
     axis 10 -20 30 XYZ
     dof rx ry rz
     limits (-20.0 45.0)
            (-30.0 30.0)
            (-35.0 25.0)
  end
  begin
     id 2
     name thigh
     direction 0.6 -0.8 0
     length 4
     axis 0 0 20 XYZ
     dof rx
     limits (-10.0 170.0)
  end
  begin
     id 3
     name foot
     direction 0 -0.6 0.8
     length 1
     axis -90 0 20 XYZ
     dof rx rz
     limits (-45.0 90.0)
            (-70.0 20.0)
  end
:hierarchy
  begin
    root back thigh
    thigh foot
  end
)";

inline const std::string kAmc = R"(#!OML:ASF
:FULLY-SPECIFIED
:DEGREES
1
root 1 5 3 10 20 30
back 5 6 7
thigh 45
foot -20 15
2
root 2 5.5 4 -100 80 170
back 44 -29 -34
thigh 100
foot 89 -69
)";

// Captured figures stand up along y and look along z.
inline glm::dvec3 in_our_axes(const glm::dvec3& place) { return {place.z, place.x, place.y}; }

// Where joints of the film's first actor are.
class FilmPlaces {
 public:
  explicit FilmPlaces(const std::filesystem::path& path) : film(animator::read_film(path)), frames_(film) {}

  glm::dvec3 at(const std::string& name, std::uint32_t frame) {
    const auto& joints = film.model_of(0).joints;
    for (std::size_t joint = 0; joint < joints.size(); ++joint)
      if (joints[joint].name == name) return frames_.frame_of(0, joint, frame).place;
    ADD_FAILURE() << "no joint " << name;
    return {};
  }

  const modeler::Joint& joint(const std::string& name) const {
    for (const modeler::Joint& joint : film.model_of(0).joints)
      if (joint.name == name) return joint;
    throw Failure("no joint", name, "");
  }

  const animator::Film film;

 private:
  animator::JointFrames frames_;
};

// Every joint at every frame of the film, of which each is `every` of the file's.
inline void expect_places(FilmPlaces& film, const std::vector<test::Places>& expected, std::size_t every, double factor,
                          double error) {
  ASSERT_EQ(film.film.frames, (expected.size() - 1) / every + 1);
  for (std::uint32_t frame = 0; frame < film.film.frames; ++frame)
    for (const auto& [name, place] : expected[frame * every]) {
      const glm::dvec3 wanted = factor * in_our_axes(place), found = film.at(name, frame);
      for (int axis = 0; axis < 3; ++axis)
        ASSERT_NEAR(found[axis], wanted[axis], error) << name << " at frame " << frame;
    }
}

}  // namespace mars::importer
