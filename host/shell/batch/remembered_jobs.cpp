#include "host/shell/batch/remembered_jobs.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>

#include "hal/failure/failure.h"
#include "host/content/document/file.h"
#include "host/content/document/whole_file.h"
#include "host/render/sinks/record.h"

namespace mars::batch {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr std::size_t kLongestNumber = 20;  // digits

std::vector<std::string> numbers_in(const std::string& text) {
  const json object = sinks::parse_record(text);
  std::vector<std::string> numbers;
  for (const json& job : sinks::Record(object).list("jobs")) {
    const std::string number = sinks::Record(job).text("job", kLongestNumber);
    if (number.empty() || number.find_first_not_of("0123456789") != std::string::npos)
      sinks::refuse_value("job", number, "a number");
    numbers.push_back(number);
  }
  return numbers;
}

// In what sbatch takes, % begins a field.
std::string escaped(const std::string& path) {
  std::string text;
  for (const char letter : path) text += letter == '%' ? "%%" : std::string(1, letter);
  return text;
}

}  // namespace

fs::path RememberedJobs::write_script(const std::string& text) const {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) document::fail_file("create the folder", folder_, error.value());
  const fs::path script = folder_ / "job.sbatch";
  document::write_whole_file(script, text);
  return script;
}

void RememberedJobs::add(const std::string& number) const {
  json jobs = json::array();
  for (const std::string& each : numbers()) jobs.push_back({{"job", each}});
  jobs.push_back({{"job", number}});
  document::write_whole_file(jobs_file(), json{{"jobs", jobs}}.dump(2) + "\n");
}

std::vector<std::string> RememberedJobs::numbers() const {
  const std::optional<std::string> text = document::read_file_if_there(jobs_file(), sinks::kLargestRecord);
  if (!text) return {};
  try {
    return numbers_in(*text);
  } catch (const Failure& failure) {
    throw Failure("not a list of jobs: " + failure.problem, jobs_file().string(), "remove it; squeue shows the jobs");
  }
}

std::string RememberedJobs::output_pattern(bool array) const {
  return escaped(fs::absolute(folder_).string()) + (array ? "/%A_%a.out" : "/%j.out");
}

}  // namespace mars::batch
