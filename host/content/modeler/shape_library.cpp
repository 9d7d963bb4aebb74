#include "host/content/modeler/shape_library.h"

#include <algorithm>

#include "host/content/document/fields.h"
#include "host/content/modeler/body_shapes.h"
#include "host/content/modeler/limb_shapes.h"
#include "host/content/modeler/primitives.h"
#include "host/content/modeler/teapot.h"

namespace mars::modeler {
namespace {

constexpr const keys::Key* kNothing = nullptr;
using keys::kEdge, keys::kEnds, keys::kLid, keys::kRim, keys::kTop, keys::kTube;

template <std::vector<wire::Patch> (*make)()>
std::vector<wire::Patch> plain(const OptionValues&) {
  return make();
}

template <std::vector<wire::Patch> (*make)(double)>
std::vector<wire::Patch> varied(const OptionValues& values) {
  return make(values[0]);
}

template <BodyPart part>
std::vector<wire::Patch> of_body(const OptionValues&) {
  return make_body(part);
}

constexpr LibraryShape kLibrary[] = {
    {"box", "six flat sides", kNothing, plain<make_box>},
    {"rounded_box", "a box with round edges and corners", &kEdge, make_rounded_box},
    {"sphere", "a ball", kNothing, plain<make_sphere>},
    {"ellipsoid", "a sphere by the name it has in an sbb that is no cube", kNothing, plain<make_sphere>},
    {"cylinder", "round about z, closed by flat ends", kNothing, plain<make_cylinder>},
    {"capsule", "a cylinder with round ends", &kEnds, varied<make_capsule>},
    {"cone", "pointed or blunt, round about z", &kTop, varied<make_cone>},
    {"disc", "a flat round body with a round rim: a wheel, a coin", &kRim, varied<make_disc>},
    {"torus", "a ring round about z", &kTube, varied<make_torus>},
    {"teapot", "Newell's, z up, its spout towards x", &kLid, varied<make_teapot>},
    {"upper_limb", "an upper arm or thigh of any creature", kNothing, plain<make_upper_limb>},
    {"lower_limb", "a forearm or shin of any creature", kNothing, plain<make_lower_limb>},
    {"hand", "a mitten, left or right, thumb forward", kNothing, plain<make_hand>},
    {"head", "with nose, jaw and ears, from under the chin", kNothing, of_body<BodyPart::head>},
    {"hair", "short, in the head's frame", kNothing, of_body<BodyPart::hair>},
    {"neck", "broad at its foot", kNothing, of_body<BodyPart::neck>},
    {"torso", "neckline to waist", kNothing, of_body<BodyPart::torso>},
    {"abdomen", "waist to the shirt's hem", kNothing, of_body<BodyPart::abdomen>},
    {"pelvis", "waist to crotch", kNothing, of_body<BodyPart::pelvis>},
    {"upper_arm", "shoulder to elbow", kNothing, of_body<BodyPart::upper_arm>},
    {"sleeve", "short, over an upper arm", kNothing, of_body<BodyPart::sleeve>},
    {"forearm", "elbow to wrist", kNothing, of_body<BodyPart::forearm>},
    {"left_hand", "five fingers, palm inward, thumb forward", kNothing, of_body<BodyPart::left_hand>},
    {"right_hand", "five fingers, palm inward, thumb forward", kNothing, of_body<BodyPart::right_hand>},
    {"thigh", "hip to knee", kNothing, of_body<BodyPart::thigh>},
    {"shin", "knee to a trouser's hem", kNothing, of_body<BodyPart::shin>},
    {"foot", "a shoe from heel to ball", kNothing, of_body<BodyPart::foot>},
    {"toes", "the shoe's front", kNothing, of_body<BodyPart::toes>},
};

}  // namespace

std::span<const LibraryShape> shape_library() { return kLibrary; }

const LibraryShape* find_library_shape(std::string_view name) {
  const auto found = std::find_if(std::begin(kLibrary), std::end(kLibrary),
                                  [&](const LibraryShape& shape) { return shape.name == name; });
  return found == std::end(kLibrary) ? nullptr : found;
}

std::string likely_shape(std::string_view wanted, std::span<const std::string_view> own) {
  std::vector<std::string_view> names(own.begin(), own.end());
  for (const LibraryShape& shape : kLibrary) names.push_back(shape.name);
  return document::did_you_mean(wanted, names, "name a shape of the library, or define it in the model's shapes");
}

}  // namespace mars::modeler
