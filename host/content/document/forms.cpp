#include "host/content/document/forms.h"

#include <algorithm>

namespace mars::document {
namespace {

// The more particular before the more general.
constexpr Form kForms[] = {
    {"/color", R"("linear")"},
    {"/ambient", "[0.8, 0.9, 1]"},
    {"pose.*", "[0, 90, 0]"},
    {"segments.*", "[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]"},
    {"materials.*", R"({"color": [0.8, 0.4, 0.2]})"},
    {"models.*", R"("robot.json")"},
    {"ambient.ground", "[0.4, 0.3, 0.2]"},
    {"joints.*", "[1, 1, 1.2]"},
    {"branches.*", "[1, 1, 1.2]"},
    {"proportions.joints", R"({"thigh": [1, 1, 1.2]})"},
    {"proportions.branches", R"({"leg-*": 1.1})"},
    {"u.ends", R"("clamped")"},
    {"v.ends", R"("clamped")"},
    {"limits.x", "[-30, 30]"},
    {"limits.y", "[-30, 30]"},
    {"limits.z", "[-30, 30]"},

    {"version", "2"},
    {"frames", "48"},
    {"rate", "24"},
    {"size", "[960, 540]"},
    {"samples", "4"},
    {"curve", R"("filmic")"},
    {"fog", R"({"start": 10, "end": 100})"},
    {"start", "10"},
    {"end", "100"},
    {"sky", "[0.8, 0.9, 1]"},
    {"background", "[0.1, 0.2, 0.3]"},
    {"intervals", R"("auto")"},
    {"camera", R"({"eye": [0, -9, 2], "at": [0, 0, 1]})"},
    {"lights", R"([{"direction": [-0.4, -0.7, 0.8]}])"},
    {"materials", R"({"oak": {"color": [0.7, 0.5, 0.3]}})"},
    {"models", R"({"robot": "robot.json"})"},
    {"actors", R"([{"name": "anna", "model": "robot"}])"},
    {"keys", R"([{"frame": 0}, {"frame": 24}])"},
    {"frame", "24"},
    {"ease", "[0.4, 0, 0.6, 1]"},
    {"eye", "[0, -9, 2]"},
    {"at", "[0, 0, 1]"},
    {"up", "[0, 0, 1]"},
    {"fov", "40"},
    {"exposure", "0.5"},
    {"near", "0.1"},
    {"far", "10000"},
    {"direction", "[-0.4, -0.7, 0.8]"},
    {"place", "[1, 0, 0.5]"},
    {"turn", "[0, 0, 90]"},
    {"attach", R"({"actor": "tom", "joint": "right-hand"})"},
    {"actor", R"("tom")"},
    {"joint", R"("right-hand")"},
    {"offset", "[0, 0, 0.2]"},
    {"axes", R"("joint")"},
    {"level", "true"},
    {"pose", R"({"elbow": [0, 90, 0]})"},
    {"color", "[0.8, 0.4, 0.2]"},
    {"intensity", "1"},
    {"cone", "[30, 40]"},
    {"reach", "5"},
    {"ambient", "0.1"},
    {"diffuse", "0.65"},
    {"specular", "0.45"},
    {"exponent", "32"},
    {"roughness", "0.5"},
    {"metallic", "1"},
    {"refraction", "1.5"},
    {"reflection", R"("phong")"},
    {"interpolation", R"("phong")"},
    {"sides", "2"},
    {"name", R"("anna")"},
    {"model", R"("robot")"},
    {"material", R"("oak")"},
    {"matrices", R"([{"frame": 0, "segments": {"hand": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]}}])"},
    {"segments", R"({"hand": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]})"},

    {"joints", R"([{"name": "foot"}, {"name": "knee", "parent": "foot"}])"},
    {"parent", R"("foot")"},
    {"x_axis", "[1, 0, 0]"},
    {"y_axis", "[0, 1, 0]"},
    {"limits", R"({"x": [-30, 30]})"},
    {"segment", R"({"shape": "box"})"},
    {"shape", R"("box")"},
    {"sbb", "[[0, 0, 0], [1, 1, 1]]"},
    {"from", R"("human.json")"},
    {"proportions", R"({"scale": 1.1})"},
    {"scale", "[1, 1, 1.2]"},
    {"height", "1.8"},
    {"ground", "true"},
};

// Within a part of a film's key, which are written as the part is without them.
bool in_a_part(std::string_view key) { return key == "value" || key == "in" || key == "out"; }

// A key, and that of the object it stands in: "" where that is an item of a list, or the file itself.
struct Named {
  std::string_view key, above;
  bool outermost;
};

bool fits(std::string_view form, const Named& named) {
  if (form[0] == '/') return named.outermost && form.substr(1) == named.key;
  const std::size_t dot = form.find('.');
  if (dot == std::string_view::npos) return form == named.key;
  return form.substr(0, dot) == named.above && (form.substr(dot + 1) == "*" || form.substr(dot + 1) == named.key);
}

}  // namespace

std::span<const Form> forms() { return kForms; }

std::string form_of(const Element& element) {
  std::optional<Element> keyed = element;
  while (keyed && keyed->key().empty()) keyed = keyed->parent();
  if (!keyed) return "";
  const std::string_view key = keyed->key();
  if (const auto part = keyed->parent(); in_a_part(key) && part && part->parent()) keyed = part;
  const std::optional<Element> above = keyed->parent();
  const Named named{keyed->key(), above->key(), !above->parent()};
  const auto form = std::ranges::find_if(kForms, [&](const Form& each) { return fits(each.key, named); });
  if (form == std::end(kForms)) return "";
  return "\"" + std::string(key) + "\": " + std::string(form->value);
}

}  // namespace mars::document
