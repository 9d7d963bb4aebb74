// What hands do, as words of the commands that do the same.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <map>
#include <string>
#include <vector>

#include "host/editing/command.h"
#include "host/studio/project/project.h"

namespace mars::studio {

// A step of one command.
Json step_of(const editing::Command& words);

// To nine digits, as people will read it in the file.
std::string shown_number(double number);
std::string shown_numbers(std::initializer_list<double> numbers);  // "1,2,3"
std::string shown_numbers(const glm::dvec3& vector);

// "left-knee=0,10,0": a joint's pose as a setting of `animate pose`.
std::string joint_setting(const std::string& joint, const glm::dvec3& pose);

// A model that is open, posed.
Json posed_model(const std::map<std::string, glm::dvec3>& pose);

// Parts of a thing of the film ("tom", "camera", "light/2") set at the frame that is shown, within limits.
Json pose_step(const Project& project, const std::string& thing, const std::vector<std::string>& settings);

// The same of the camera or a light: parts that keys of the film change get a key at the frame that is shown, others
// are changed for the whole film. So a lamp that is set up at frame 110 does not fly there from where it stood at frame
// 0.
Json set_step(const Project& project, const std::string& thing, const std::vector<std::string>& settings);

// A step of pose_step() whose change is blended over as many frames to both sides; other steps stay as they are.
Json blended(Json step, std::uint32_t frames);

// Throws where another actor carries it at the frame: its own place and turn then count for nothing.
void refuse_carried(const Project& project, std::size_t actor);

// `mars model ... VERB JOINT OPTIONS`.
Json joint_step(const std::string& verb, const std::string& joint, const std::vector<std::string>& options);

// "--place", "1", "2", "3".
void add_option(std::vector<std::string>& options, const char* name, std::initializer_list<double> numbers);

}  // namespace mars::studio
