#include "host/content/importer/import_motion.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

#include "hal/failure/failure.h"
#include "host/content/document/text.h"
#include "host/content/importer/joint_names.h"
#include "host/content/importer/limbs/find_limbs.h"
#include "host/content/importer/motions/asf_file.h"
#include "host/content/importer/motions/bvh_file.h"
#include "host/content/importer/motions/film_text.h"
#include "host/content/importer/motions/motion_frames.h"
#include "host/content/importer/motions/skeleton_model.h"

namespace mars::importer {
namespace {

namespace fs = std::filesystem;

constexpr double kRateOfAmc = 120;    // of CMU's motions, which do not say it
constexpr double kPlaceError = 1e-6;  // of the figure's size
constexpr std::size_t kMostFrames = 1'000'000;

struct Read {
  Skeleton skeleton;
  Motion motion;  // without frames: none was read
  std::vector<std::string> made, not_read, takes;
};

// The one beside the motion whose name is the beginning of the motion's, or the only one there.
fs::path skeleton_beside(const fs::path& motion) {
  std::vector<fs::path> all;
  std::error_code none;
  const fs::path folder = motion.parent_path().empty() ? fs::path(".") : motion.parent_path();
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none))
    if (same_ending(entry.path(), ".asf")) all.push_back(entry.path());
  std::ranges::sort(all);
  const std::string name = motion.stem().string();
  const fs::path* best = all.size() == 1 ? all.data() : nullptr;
  std::size_t longest = 0;
  for (const fs::path& path : all)
    if (const std::string stem = path.stem().string(); name.starts_with(stem) && stem.size() >= longest)
      best = &path, longest = stem.size();
  if (best == nullptr)
    throw Failure("needs its skeleton, an .asf file, which is not beside it", motion.string(),
                  "name it: --skeleton 02.asf");
  return motion.parent_path().empty() ? best->filename() : *best;
}

void append(Motion& all, const Motion& more) {
  all.rate = more.rate;
  all.places.insert(all.places.end(), more.places.begin(), more.places.end());
  all.poses.insert(all.poses.end(), more.poses.begin(), more.poses.end());
}

Read read_acclaim(const ImportOptions& options, FileKind kind) {
  const bool alone = kind == FileKind::asf;
  const fs::path path = alone                      ? options.from
                        : options.skeleton.empty() ? skeleton_beside(options.from)
                                                   : options.skeleton;
  const AsfFile asf = read_asf(path);
  Read read{asf.skeleton, {}, {}, asf.not_read, {}};
  if (!alone) {
    const double rate = options.file_rate.value_or(kRateOfAmc);
    append(read.motion, read_amc(options.from, asf, rate));
    for (const fs::path& more : options.more) {
      read.takes.push_back(more.filename().string() + " from the file's frame " +
                           std::to_string(read.motion.poses.size()));
      append(read.motion, read_amc(more, asf, rate));
    }
    read.made.push_back("the skeleton of " + path.filename().string());
  }
  return read;
}

Read read_motion_file(const ImportOptions& options, FileKind kind) {
  if (kind != FileKind::bvh) return read_acclaim(options, kind);
  BvhFile bvh = read_bvh(options.from);
  bvh.motion.rate = options.file_rate.value_or(whole_rate(bvh.motion.rate));
  return {std::move(bvh.skeleton), std::move(bvh.motion), std::move(bvh.remarks), std::move(bvh.not_read), {}};
}

// As a model can have them.
void name_joints(Skeleton& skeleton) {
  JointNames names;
  for (modeler::Joint& joint : skeleton.joints) joint.name = names.unused(joint.name);
}

// So that its lowest point at rest is at height 0; what the first joint does then is the actor's place.
void stand_on_floor(Skeleton& skeleton) {
  glm::dvec3& place = skeleton.joints[0].place;
  place = glm::dvec3(0);
  place.z = -rest_box(skeleton).min.z;
}

// The skeleton's model, with the limbs that its joints' names say. Their axes and limits stay the file's, as the
// motion's numbers do.
document::Json model_of(const Skeleton& skeleton, const std::string& file, ImportReport& report) {
  document::Json model = skeleton_model(skeleton, file);
  FigureTree tree;
  for (const modeler::Joint& joint : skeleton.joints)
    tree.push_back({joint.name, joint.parent,
                    joint.place + (joint.parent == modeler::kNone ? glm::dvec3(0) : tree[joint.parent].place)});
  const FiguresLimbs found = find_limbs(tree, {}, false);
  for (const auto& [limb, joint] : named(found.limbs)) {
    const std::size_t dot = limb.find('.');
    document::Json& limbs = model["limbs"];
    (dot == std::string::npos ? limbs[limb] : limbs[limb.substr(0, dot)][limb.substr(dot + 1)]) = tree[joint].name;
  }
  if (!found.limbs_made.empty()) report.made.push_back(found.limbs_made);
  for (const std::string& doubt : found.doubts) report.not_read.push_back("limbs: " + doubt);
  return model;
}

double size_of(const SkeletonBox& box) { return glm::length(box.max - box.min); }

std::string box_text(const SkeletonBox& box, const std::string& up) {
  const glm::dvec3 extent = box.max - box.min;
  return document::formatted("%.4g x %.4g x %.4g units at rest", extent.x, extent.y, extent.z) + ", the file's " + up +
         " upward";
}

// All that any joint reaches.
SkeletonBox box_of_motion(const Skeleton& skeleton, const Motion& motion) {
  std::optional<SkeletonBox> box;
  for (std::size_t frame = 0; frame < motion.poses.size(); ++frame)
    for (const glm::dvec3& place : places_of(skeleton, motion.places[frame], motion.poses[frame]))
      box = box ? SkeletonBox{glm::min(box->min, place), glm::max(box->max, place)} : SkeletonBox{place, place};
  return *box;
}

void list_read(const Read& read, ImportReport& report) {
  report.read.push_back(document::counted(read.skeleton.joints.size(), "joint"));
  if (read.motion.poses.empty()) return;
  report.read.push_back(document::counted(read.motion.poses.size(), "frame") + " at " +
                        document::shown(read.motion.rate) + " a second");
  report.made = read.takes;
}

std::string widened_text(const std::vector<std::string>& names) {
  std::string text =
      "wider limits for " + document::counted(names.size(), "joint") + " that the motion takes beyond them: ";
  for (std::size_t i = 0; i < names.size() && i < 5; ++i) text += (i > 0 ? ", " : "") + names[i];
  return names.size() > 5 ? text + ", ..." : text;
}

ImportedText film_of(const ImportOptions& options, Read read, ImportReport report) {
  const double rate = options.rate.value_or(kind_rate(read.motion.rate));
  if (double(read.motion.poses.size()) * rate / read.motion.rate > kMostFrames)
    throw Failure("has more than a million frames at this rate", options.from.string(), "choose a lower --rate");
  Motion motion = at_rate(read.skeleton.joints, read.motion, rate);
  const std::vector<std::string> widened = fit_limits(read.skeleton.joints, motion);
  if (!widened.empty()) report.made.push_back(widened_text(widened));
  const SkeletonBox box = box_of_motion(read.skeleton, motion);
  const double size = size_of(rest_box(read.skeleton));
  ActorMotion acted{motion.places, motion.poses};
  for (glm::dvec3& place : acted.places) place -= read.skeleton.joints[0].place;
  ActorText actor = actor_text(options.joint, read.skeleton.joints, acted, kPlaceError * size);
  report.model = "film of " + document::counted(motion.poses.size(), "frame") + " at " + document::shown(rate) +
                 " a second, actor '" + options.joint + "'";
  report.made.push_back("keys at " + document::counted(actor.keys, "frame"));
  const glm::dvec3 margin(size * 0.1);
  const document::Json model = model_of(read.skeleton, options.from.string(), report);
  FilmText film{motion.poses.size(),
                rate,
                options.joint,
                {{document::laid_out(model)}},
                camera_text(box.min - margin, box.max + margin),
                std::move(actor.json)};
  return {report, film_text(std::move(film))};
}

}  // namespace

ImportedText import_motion(const ImportOptions& options, FileKind kind, const std::string& up,
                           const glm::dmat3& upright) {
  Read read = read_motion_file(options, kind);
  const Skeleton turned = placed(read.skeleton, upright, 1);
  const SkeletonBox in_file = rest_box(turned);
  const double factor = options.size.factor(in_file.max.z - in_file.min.z, options.from.string());
  read.motion = placed(std::move(read.motion), upright, factor);
  read.skeleton = placed(std::move(read.skeleton), upright, factor);
  name_joints(read.skeleton);
  stand_on_floor(read.skeleton);
  ImportReport report{"", box_text(rest_box(read.skeleton), up), {}, {}, {}, read.not_read};
  list_read(read, report);
  report.made.insert(report.made.begin(), read.made.begin(), read.made.end());
  if (options.as != ImportAs::film) {
    if (!read.motion.poses.empty())
      report.not_read.push_back(document::counted(read.motion.poses.size(), "frame") +
                                " of motion (--as film makes keys of them)");
    report.model = "model of " + document::counted(read.skeleton.joints.size(), "joint") + ", the first '" +
                   read.skeleton.joints[0].name + "'";
    std::string text = document::laid_out(model_of(read.skeleton, options.from.string(), report));
    return {report, {{std::move(text)}}};
  }
  if (read.motion.poses.empty())
    throw Failure("has no motion, and a film shows one", options.from.string(), "import it --as model");
  return film_of(options, std::move(read), std::move(report));
}

}  // namespace mars::importer
