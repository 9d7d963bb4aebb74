#include "host/experiments/platform.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>
#include <vector>

#include "hal/failure/failure.h"
#include "host/child/environment.h"
#include "host/content/document/fields.h"
#include "node/wire/work.h"
#include "topology/memory_limit.h"

namespace mars::experiments {
namespace {

namespace fs = std::filesystem;

using document::Fields;
using document::Keys;
using std::string_view;
using wire::Work;

constexpr string_view kHere = "here";
constexpr string_view kPlatformNames[] = {"name",    "about",   "doubt", "computers", "host",          "noise",
                                          "network", "storage", "work",  "spread",    "not_identified"};
constexpr string_view kComputerNames[] = {"nodes", "processors", "memory", "speeds"};
constexpr string_view kHostNames[] = {"apart", "processors", "memory", "speed"};
constexpr string_view kNoiseNames[] = {"seed", "stragglers", "slowdown", "detours", "detour", "lengths"};
constexpr string_view kStorageNames[] = {"rate", "openings", "file_part", "servers", "stripe", "writer_rate"};
constexpr string_view kNetworkNames[] = {"topology", "latency",   "hop",        "rate",          "uplink",
                                         "leaf",     "send",      "receive",    "host_end",      "copy_rate",
                                         "eager",    "host_rate", "local_rate", "local_latency", "host_latency"};
constexpr string_view kSpreadNames[] = {"nodes", "files", "low", "middle", "high"};
constexpr Keys kPlatformKeys{"platform", kPlatformNames};
constexpr Keys kComputerKeys{"computer", kComputerNames};
constexpr Keys kHostKeys{"host", kHostNames};
constexpr Keys kNoiseKeys{"noise", kNoiseNames};
constexpr Keys kNetworkKeys{"network", kNetworkNames};
constexpr Keys kStorageKeys{"storage", kStorageNames};
constexpr Keys kWorkKeys{"work", wire::kWorkNames};
constexpr Keys kSpreadKeys{"spread", kSpreadNames};
constexpr std::array<string_view, 4> kTopologies{"switch", "hypercube", "fat tree", "dragonfly"};
constexpr std::array<string_view, 2> kLengths{"fixed", "exponential"};

constexpr document::Range kSeconds{0, 1e6};
constexpr document::Range kRates{1, 1e15};  // bytes, or files, a second
constexpr document::Range kParts{1e-4, 2};
constexpr document::Range kRatios{1e-3, 1e3};
constexpr document::Range kSlowdowns{1, 1e3};
constexpr document::Range kDetours{0, 1e4};  // a second
constexpr double kMostOfDetours = 0.9;       // of a processor's time
constexpr std::uint32_t kMany = 1 << 20;
constexpr std::uint32_t kManyServers = 1 << 12;
constexpr std::uint32_t kLeastStripe = 1 << 12;  // bytes
constexpr std::uint32_t kLongest = 1u << 31;     // bytes of a message

// Seconds a byte, or a file; 0 where the rate is not given: as fast as can be.
double unit_seconds(const Fields& fields, string_view key) {
  const auto rate = fields.find(key);
  return rate ? 1 / document::read_number(*rate, kRates) : 0;
}

bool read_flag(const Fields& fields, string_view key) {
  const auto flag = fields.find(key);
  if (flag) document::require_kind(*flag, document::Kind::boolean);
  return flag && flag->boolean();
}

// [bytes, seconds] pairs, or one number for messages of any length.
std::vector<simulated::EndCost> read_costs(const Fields& fields, string_view key) {
  std::vector<simulated::EndCost> costs;
  const auto list = fields.find(key);
  if (!list) return costs;
  if (list->kind() == document::Kind::number) return {{0, document::read_number(*list, kSeconds)}};
  document::require_kind(*list, document::Kind::list);
  for (const document::Element pair : *list) {
    document::require_size(pair, 2);
    auto item = pair.begin();
    const auto from = static_cast<std::size_t>(document::read_count(*item, 0, kLongest));
    if (!costs.empty() && from <= costs.back().from) pair.refuse("is not in order", "sort the costs by their bytes");
    costs.push_back({from, document::read_number(*++item, kSeconds)});
  }
  return costs;
}

// [computers, speed] pairs.
std::vector<simulated::SpeedKind> read_speeds(const Fields& computers) {
  std::vector<simulated::SpeedKind> kinds;
  const auto list = computers.find("speeds");
  if (!list) return kinds;
  document::require_kind(*list, document::Kind::list);
  for (const document::Element pair : *list) {
    document::require_size(pair, 2);
    auto item = pair.begin();
    const auto count = static_cast<int>(document::read_count(*item, 1, kMany));
    kinds.push_back({count, document::read_number(*++item, kRatios)});
  }
  if (kinds.empty()) list->refuse("is empty", "give [computers, speed] pairs, or leave it out");
  return kinds;
}

// A number, or the least and the greatest.
void read_slowdown(const document::Element& element, simulated::Noise& noise) {
  if (element.kind() == document::Kind::number) {
    noise.least_slowdown = noise.most_slowdown = document::read_number(element, kSlowdowns);
    return;
  }
  document::require_kind(element, document::Kind::list);
  document::require_size(element, 2);
  auto item = element.begin();
  noise.least_slowdown = document::read_number(*item, kSlowdowns);
  noise.most_slowdown = document::read_number(*++item, kSlowdowns);
  if (noise.most_slowdown < noise.least_slowdown) element.refuse("is not in order", "the least comes first");
}

simulated::Noise read_noise(const Fields& platform) {
  simulated::Noise noise;
  const auto element = platform.find("noise");
  if (!element) return noise;
  const Fields fields(*element, kNoiseKeys);
  noise.seed = fields.count("seed", 0, 0, std::numeric_limits<std::uint32_t>::max());
  noise.stragglers = fields.number("stragglers", 0, {0, 1});
  if (noise.stragglers > 0) read_slowdown(fields.required("slowdown"), noise);
  noise.detours = fields.number("detours", 0, kDetours);
  noise.lengths = static_cast<simulated::Lengths>(fields.choice("lengths", 0, kLengths));
  if (noise.detours == 0) return noise;
  const document::Element detour = fields.required("detour");
  noise.detour = document::read_number(detour, kSeconds);
  if (noise.detours * noise.detour > kMostOfDetours)
    detour.refuse("times detours is more than 90 % of the time", "give fewer or shorter detours");
  return noise;
}

simulated::Network read_network(const document::Element& element) {
  const Fields fields(element, kNetworkKeys);
  simulated::Network network;
  network.topology = static_cast<simulated::Topology>(fields.choice("topology", 0, kTopologies));
  network.latency = fields.number("latency", 0, kSeconds);
  network.hop = fields.number("hop", 0, kSeconds);
  network.byte = unit_seconds(fields, "rate");
  network.uplink = unit_seconds(fields, "uplink");
  network.leaf = static_cast<int>(fields.count("leaf", 1, 1, kMany));
  network.local_latency = fields.number("local_latency", 0, kSeconds);
  network.local_byte = unit_seconds(fields, "local_rate");
  network.host_latency = fields.number("host_latency", 0, kSeconds);
  network.host_byte = unit_seconds(fields, "host_rate");
  network.copy_byte = unit_seconds(fields, "copy_rate");
  network.send = read_costs(fields, "send");
  network.receive = read_costs(fields, "receive");
  network.host_end = read_costs(fields, "host_end");
  if (const auto eager = fields.find("eager")) network.eager = document::read_count(*eager, 0, kLongest);
  return network;
}

// Where it says nothing, storage is as fast as can be.
void read_storage(const Fields& platform, Platform& into) {
  const auto storage = platform.find("storage");
  if (!storage) return;
  const Fields fields(*storage, kStorageKeys);
  into.machine.storage.byte = unit_seconds(fields, "rate");
  into.machine.storage.opening = unit_seconds(fields, "openings");
  into.machine.storage.writer_byte = unit_seconds(fields, "writer_rate");
  into.machine.storage.servers = static_cast<int>(fields.count("servers", 1, 1, kManyServers));
  into.machine.storage.stripe = fields.count("stripe", 0, kLeastStripe, kLongest);
  into.file_part = fields.number("file_part", into.file_part, kParts);
}

std::vector<double> read_costs_of_work(const document::Element& element) {
  const Fields fields(element, kWorkKeys);
  std::vector<double> work;
  for (const string_view name : wire::kWorkNames) work.push_back(fields.number(name, 0, kSeconds));
  return work;
}

Spread read_spread(const document::Element& element) {
  const Fields fields(element, kSpreadKeys);
  const auto ratio = [&](string_view key) { return document::read_number(fields.required(key), kRatios); };
  const Spread spread{static_cast<int>(document::read_count(fields.required("nodes"), 1, kMany)),
                      read_flag(fields, "files"), ratio("low"), ratio("middle"), ratio("high")};
  if (spread.low > spread.middle || spread.middle > spread.high)
    element.refuse("is not in order", "low is the least, high the greatest");
  return spread;
}

std::vector<Spread> read_spreads(const Fields& platform) {
  std::vector<Spread> spreads;
  const auto list = platform.find("spread");
  if (!list) return spreads;
  document::require_kind(*list, document::Kind::list);
  for (const document::Element element : *list) spreads.push_back(read_spread(element));
  return spreads;
}

// Those that there are, for messages.
std::string names_in(const fs::path& folder) {
  std::vector<std::string> names{std::string(kHere)};
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem());
  std::ranges::sort(names);
  return document::joined(names, " or ");
}

fs::path file_of(const std::string& name, const fs::path& folder) {
  if (name.find('/') != std::string::npos || name.ends_with(".json")) return name;
  const fs::path file = name == kHere ? calibrated_platform() : folder / (name + ".json");
  if (fs::exists(file)) return file;
  if (name == kHere) throw Failure("this machine is not calibrated", file.string(), "run mars calibrate");
  throw Failure("there is no platform '" + name + "'", "", "use " + names_in(folder) + ", or a file NAME.json");
}

// Of the platform that `element` names.
fs::path file_named(const document::Element& element, const fs::path& folder) {
  const std::string name = document::read_text(element);
  try {
    return file_of(name, folder);
  } catch (const Failure& failure) {
    element.refuse(failure.problem, failure.remedy);
  }
}

std::vector<Work> read_unidentified(const Fields& platform) {
  std::vector<Work> kinds;
  const auto list = platform.find("not_identified");
  if (!list) return kinds;
  document::require_kind(*list, document::Kind::list);
  for (const document::Element kind : *list)
    kinds.push_back(static_cast<Work>(document::read_choice(kind, wire::kWorkNames)));
  return kinds;
}

// Costs that a platform gives itself.
void read_own_work(const Fields& fields, Platform& into) {
  into.machine.work = read_costs_of_work(fields.required("work"));
  into.unidentified = read_unidentified(fields);
}

// Those that it gives, or those of the platform that it names, which gives them itself.
void read_work(const Fields& fields, const fs::path& folder, Platform& into) {
  const document::Element element = fields.required("work");
  if (element.kind() != document::Kind::text) return read_own_work(fields, into);
  const document::Document other = document::read_document(file_named(element, folder));
  const Fields others(other.root(), kPlatformKeys);
  const document::Element work = others.required("work");
  if (work.kind() == document::Kind::text) work.refuse("is work of work", "name a platform that has costs of its own");
  read_own_work(others, into);
}

// As a calibration has them.
void require_all_costs(const document::Element& root) {
  const Fields work(Fields(root, kPlatformKeys).required("work"), kWorkKeys);
  for (const string_view name : wire::kWorkNames) static_cast<void>(work.required(name));
}

Platform read(const document::Element& root, const fs::path& folder) {
  const Fields fields(root, kPlatformKeys);
  Platform platform;
  platform.name = document::read_text(fields.required("name"));
  platform.about = fields.text("about", "");
  platform.doubt = fields.text("doubt", "");
  const Fields computers(fields.required("computers"), kComputerKeys);
  platform.memory = static_cast<std::uint64_t>(computers.number("memory", 1 << 30, {1 << 20, 1e15}));
  platform.machine.nodes = static_cast<int>(computers.count("nodes", 1, 1, kMany));
  platform.machine.processors = static_cast<int>(computers.count("processors", 1, 1, kMany));
  const Fields host(fields.required("host"), kHostKeys);
  platform.machine.speeds = read_speeds(computers);
  platform.machine.noise = read_noise(fields);
  platform.machine.host_apart = read_flag(host, "apart");
  platform.machine.host_speed = host.number("speed", 1, kRatios);
  platform.machine.host_processors = static_cast<int>(host.count("processors", 1, 1, kMany));
  platform.host_memory = static_cast<std::uint64_t>(host.number("memory", topology::kMostShare, {1 << 20, 1e15}));
  platform.machine.network = read_network(fields.required("network"));
  read_storage(fields, platform);
  read_work(fields, folder, platform);
  platform.spread = read_spreads(fields);
  return platform;
}

Platform read_one(const std::string& name, const fs::path& folder) {
  const fs::path file = file_of(name, folder);
  const document::Document document = document::read_document(file);
  try {
    if (name == kHere) require_all_costs(document.root());
    return read(document.root(), folder);
  } catch (const Failure&) {
    if (name != kHere) throw;
    throw Failure("another version of MARS measured this machine", file.string(), "run mars calibrate");
  }
}

}  // namespace

Platform read_platform(const std::string& name, const fs::path& folder) {
  const std::size_t colon = name.rfind(':');
  if (colon == std::string::npos || fs::exists(name)) return read_one(name, folder);
  Platform platform = read_one(name.substr(0, colon), folder);
  const Platform costs = read_one(name.substr(colon + 1), folder);
  platform.name += ":" + costs.name;
  platform.doubt = costs.doubt;
  platform.spread.clear();
  platform.machine.work = costs.machine.work;
  platform.unidentified = costs.unidentified;
  return platform;
}

std::string doubt_text(const Platform& platform) {
  if (platform.doubt.empty()) return "";
  return "platform " + platform.name + " was measured on a machine that was too busy: " + platform.doubt +
         " (run mars calibrate when nothing else runs)";
}

std::string unidentified_text(const Platform& platform, std::span<const Work> kinds) {
  std::vector<string_view> names;
  for (const Work kind : kinds)
    if (std::ranges::count(platform.unidentified, kind) > 0)
      names.push_back(wire::kWorkNames[static_cast<std::size_t>(kind)]);
  if (names.empty()) return "";
  return "mars calibrate could not measure these kinds of work apart from others: " + document::joined(names) +
         "; the seconds are less sure for a film that has much more or less of them than the films of "
         "mars calibrate have (docs/platforms.md)";
}

double file_seconds(const simulated::Machine& machine, images::PictureFormat format, const images::FileWork& work) {
  const auto of = [&](Work kind, std::uint64_t units) {
    return machine.work[static_cast<std::size_t>(kind)] * static_cast<double>(units);
  };
  return of(Work::file, work.files) + of(encoded_byte(format), work.encoded_bytes) +
         of(Work::file_byte, work.file_bytes);
}

Platform like_here(const std::string& name, const fs::path& folder, int processors) {
  Platform platform = read_platform(name, folder);
  platform.machine.nodes = platform.machine.processors = processors;
  platform.machine.host_apart = false;
  return platform;
}

fs::path platforms_folder(const fs::path& self) {
  return self.parent_path().parent_path() / "share" / "mars" / "platforms";
}

fs::path calibrated_platform() {
  const child::Environment environment = child::own_environment();
  const fs::path home = environment.value("HOME").value_or("");
  const fs::path data = environment.value("XDG_DATA_HOME").value_or("");
  return (data.empty() ? home / ".local" / "share" : data) / "mars" / "here.json";
}

}  // namespace mars::experiments
