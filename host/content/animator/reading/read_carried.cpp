#include "host/content/animator/reading/read_carried.h"

#include <algorithm>

#include "host/content/animator/pose/attachments.h"
#include "host/content/animator/reading/read_keys.h"

namespace mars::animator {
namespace {

std::optional<Attachment> read_attachment(const document::Element& element, const Carriers& carriers) {
  if (element.kind() == document::Kind::null) return std::nullopt;
  const document::Fields fields(element, keys::object("attach"));
  const Carriers::Named named = carriers.read(fields);
  return Attachment{named.actor, named.joint, fields.vector("place"), fields.vector("turn", keys::kDegrees)};
}

// "tom is carried by ball, ball by tom"
std::string circle_text(const std::vector<Actor>& actors, const std::vector<std::size_t>& chain) {
  std::string text;
  for (std::size_t i = 0; i < chain.size(); ++i)
    text += (i == 0 ? "" : ", ") + document::in_quotes(actors[chain[i]].name) + (i == 0 ? " is carried by " : " by ") +
            document::in_quotes(actors[chain[(i + 1) % chain.size()]].name);
  return text;
}

void refuse_circle(const WrittenAttachment& written, const std::vector<Actor>& actors) {
  std::vector<std::size_t> chain = chain_at(actors, written.actor, written.frame);
  if (!attachment_at(actors[chain.back()], written.frame)) return;
  // It may be another circle, to which this actor only leads.
  const auto first = std::ranges::find(chain, chain.back()), again = std::find(first + 1, chain.end(), *first);
  if (again == chain.end() && chain.size() > kLongestChain)
    written.element.refuse("makes a chain of more than " + std::to_string(kLongestChain) + " actors",
                           "attach some of them to the same actor");
  if (again != chain.end()) chain = {first, again};
  written.element.refuse("goes round in a circle: " + circle_text(actors, chain), "detach one of them before");
}

}  // namespace

Carriers::Carriers(const std::vector<Actor>& actors, const std::vector<modeler::Model>& models)
    : actors_(actors), models_(models) {
  for (std::size_t i = 0; i < actors.size(); ++i) numbers_.emplace(actors[i].name, i);
}

Carriers::Named Carriers::read(const document::Fields& fields) const {
  const std::size_t number = actor(fields.required("actor"));
  const auto name = fields.find("joint");
  return {number, name ? joint(*name, number) : modeler::kNone};
}

std::size_t Carriers::actor(const document::Element& element) const {
  const std::string name = document::read_text(element);
  const auto found = numbers_.find(name);
  if (found == numbers_.end()) {
    std::vector<std::string_view> names;
    for (const Actor& actor : actors_) names.push_back(actor.name);
    element.refuse("is " + document::in_quotes(name) + ", which is no actor of the film",
                   document::did_you_mean(name, names, "name one of the film's actors"));
  }
  if (!actors_[found->second].matrices.empty())
    element.refuse("is " + document::in_quotes(name) + ", which is moved by matrices",
                   "name an actor that is moved by keys");
  return found->second;
}

std::size_t Carriers::joint(const document::Element& element, std::size_t actor) const {
  const std::string name = document::read_text(element);
  const auto& joints = models_[actors_[actor].model].joints;
  const auto found = std::ranges::find(joints, name, &modeler::Joint::name);
  if (found != joints.end()) return static_cast<std::size_t>(found - joints.begin());
  std::vector<std::string_view> names;
  for (const modeler::Joint& joint : joints) names.push_back(joint.name);
  element.refuse("is " + document::in_quotes(name) + ", which is no joint of " +
                     document::in_quotes(actors_[actor].name),
                 document::did_you_mean(name, names, "name one of its joints"));
}

Point read_point(const document::Element& element, const Carriers& carriers) {
  if (element.kind() != document::Kind::object) return {document::read_vector(element)};
  require_version_2(element);
  const document::Fields fields(element, keys::object("point"));
  const Carriers::Named named = carriers.read(fields);
  return {fields.vector("offset"), named.actor, named.joint, fields.choice("axes") == 1, fields.flag("level")};
}

void read_attachments(const std::vector<WrittenAttachment>& written, const std::vector<modeler::Model>& models,
                      std::vector<Actor>& actors) {
  if (written.empty()) return;
  const Carriers carriers(actors, models);
  for (const WrittenAttachment& one : written)
    actors[one.actor].attach.push_back({one.frame, read_attachment(one.element, carriers)});
  for (const WrittenAttachment& one : written) refuse_circle(one, actors);
}

}  // namespace mars::animator
