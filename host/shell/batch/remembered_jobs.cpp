#include "host/shell/batch/remembered_jobs.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <system_error>

#include "hal/failure/failure.h"
#include "host/content/document/file.h"
#include "host/content/document/whole_file.h"
#include "host/render/sinks/record.h"

namespace mars::batch {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr std::size_t kLongestNumber = 64;        // bytes
constexpr std::uintmax_t kLongestList = 1 << 20;  // bytes

std::vector<std::string> numbers_in(const std::string& text) {
  const json object = sinks::parse_record(text);
  std::vector<std::string> numbers;
  for (const json& job : sinks::Record(object).list("jobs")) {
    const std::string number = sinks::Record(job).text("job", kLongestNumber);
    if (!is_job_number(number)) sinks::refuse_value("job", number, "a number");
    numbers.push_back(number);
  }
  return numbers;
}

}  // namespace

void RememberedJobs::write_script(const std::string& text) const {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) document::fail_file("create the folder", folder_, error.value());
  document::write_whole_file(folder_ / system_.script_name, text);
  fs::remove(folder_ / "film.starts", error);
}

void RememberedJobs::add(const std::string& number) const {
  json jobs = json::array();
  for (const std::string& each : submitted()) jobs.push_back({{"job", each}});
  jobs.push_back({{"job", number}});
  document::write_whole_file(jobs_file(), json{{"jobs", jobs}}.dump(2) + "\n");
}

std::vector<std::string> RememberedJobs::submitted() const {
  const std::optional<std::string> text = document::read_file_if_there(jobs_file(), sinks::kLargestRecord);
  if (!text) return {};
  try {
    return numbers_in(*text);
  } catch (const Failure& failure) {
    throw Failure("not a list of jobs: " + failure.problem, jobs_file().string(),
                  "remove it; " + system_.list.front() + " shows the jobs");
  }
}

// A line that is not whole yet is read another time.
std::vector<std::string> RememberedJobs::numbers() const {
  std::vector<std::string> numbers = submitted();
  std::istringstream lines(document::read_file_if_there(folder_ / "again", kLongestList).value_or(""));
  for (std::string number; std::getline(lines, number) && !lines.eof();)
    if (is_job_number(number)) numbers.push_back(number);
  return numbers;
}

std::vector<Jobs> jobs_of(const fs::path& frames) {
  std::vector<Jobs> all;
  for (const BatchSystem& system : batch_systems()) {
    std::vector<std::string> numbers = RememberedJobs(frames, system).numbers();
    if (!numbers.empty()) all.push_back({&system, std::move(numbers)});
  }
  return all;
}

}  // namespace mars::batch
