// SPDX-License-Identifier: MIT
#include "app/bench/runner.h"

#include <signal.h>

#include <chrono>
#include <cstring>

#include "app/bench/machine.h"
#include "app/bench/process.h"
#include "app/bench/truth_file.h"
#include "app/frame_options.h"
#include "base/error.h"
#include "base/file.h"
#include "base/json_text.h"
#include "base/log.h"
#include "image/exr.h"
#include "image/png.h"

namespace izb::bench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Of a name that the sweeps give, which are told apart by more than what is replaced.
std::string short_word(std::string text) {
  for (char& c : text)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-') c = '_';
  return text;
}

json read_result(const fs::path& path) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return nullptr;
  return json::parse(read_text_file(path), nullptr, false);  // discarded where it is none
}

/// Whether the report can show every picture of a result.
bool has_pictures(const json& result, const fs::path& folder) {
  const json pictures = result.value("pictures", json::array());
  for (const json& group : pictures.is_array() ? pictures : json::array({pictures}))
    for (const json& file : group.at("files")) {
      const fs::path path = folder / file.at("file").get<std::string>();
      try {
        read_png(read_binary_file(path), path.string());
      } catch (const Error&) {
        return false;
      }
    }
  return true;
}

/// The job's result of an earlier run; null where there is none, or of other work, or of other conditions, or damaged.
json result_there(const Job& job, const fs::path& folder, const json& made) {
  try {
    json result = read_result(result_path(job, folder));
    if (result.is_object() && !result.contains("failed") && same_work(job_from(result.at("job")), job) &&
        same_conditions(result.at("made"), made) && has_pictures(result, folder))
      return result;
  } catch (const json::exception&) {  // JSON, but no result
  }
  return nullptr;
}

/// What the program said last before it failed.
std::string last_sentence(const fs::path& log) {
  std::istringstream in(read_text_file(log));
  std::string sentence;
  const std::string prefix = "izb: ";
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(prefix)) sentence = line.substr(prefix.size());
  return sentence;
}

/// All folders that jobs write to.
std::vector<fs::path> folders_below(const fs::path& folder) {
  std::vector<fs::path> all{folder};
  std::error_code error;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (std::error_code ignored; at->is_directory(ignored) && !at->is_symlink(ignored)) all.push_back(at->path());
  return all;
}

std::string why(const ChildEnd& end, const fs::path& log, double time_limit_s) {
  if (end.timed_out) return fmt::format("not done after {:.0f} s", time_limit_s);
  if (end.signal == SIGKILL) return "ended by the system, as it does where memory is short";
  if (end.signal != 0) return fmt::format("ended by signal {} ({})", end.signal, strsignal(end.signal));
  const std::string sentence = last_sentence(log);
  return sentence.empty() ? fmt::format("ended with exit code {}", end.exit_code) : sentence;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) fail("cannot make the folder '{}': {}", folder.string(), error.message());
}

class Runner {
 public:
  Runner(const RunOptions& options, const json& made) : options_(options), made_(made) {}

  /// Null where this process was asked to end.
  json run(const Job& job) {
    const fs::path path = result_path(job, options_.folder);
    make_folder(path.parent_path());
    // What is there is of other work, or failed; and the pictures that it names are about to be others.
    std::error_code error;
    fs::remove(path, error);
    if (error) fail("cannot replace '{}': {}", path.string(), error.message());
    fs::path log = path;
    log.replace_extension(".log");
    ChildEnd end = make_scene(job, log);
    if (end.well()) end = make_truth(job, log);
    if (end.well()) end = run_child({"bench-job", json_text(to_json(job)), path.string()}, log, options_.time_limit_s);
    if (!end.well()) clean_up();
    if (end.interrupted) return nullptr;
    json result = read_result(path);
    if (end.well() && result.is_object()) return result;
    result = {{"job", to_json(job)}, {"made", made_}, {"failed", why(end, log, options_.time_limit_s)}};
    write_file_atomically(path, json_text(result, 1) + "\n");
    return result;
  }

  /// Removes what killed children left half written.
  void clean_up() const {
    if (!options_.alone) return;
    for (const fs::path& folder : folders_below(options_.folder)) remove_stale_temporaries(folder);
  }

 private:
  ChildEnd make_scene(const Job& job, const fs::path& log) const {
    const fs::path file = job.scene.file;
    std::error_code ignored;
    if (job.scene.procedural.empty() || fs::exists(file, ignored)) return {};
    make_folder(file.parent_path());
    return run_child(
        {"scene", job.scene.procedural, "--triangles", std::to_string(job.scene.triangles), "-o", file.string()}, log,
        options_.time_limit_s);
  }

  ChildEnd make_truth(const Job& job, const fs::path& log) const {
    if (truth_rays(job) == 0) return {};
    make_folder(truth_path(job, options_.folder).parent_path());
    const fs::path path = truth_path(job, options_.folder);
    // It goes on from what an earlier run left there, unless that is damaged.
    std::error_code ignored;
    try {
      if (fs::exists(path, ignored)) read_exr(path);
    } catch (const Error&) {
      fs::remove(path, ignored);
    }
    return run_child(truth_command(job, options_.folder), log, options_.time_limit_s);
  }

  const RunOptions& options_;
  const json& made_;
};

/// A guess at a job's share of the work: pixels that it renders.
double weight(const Job& job) {
  double sum = 0.0;
  for (const Configuration& c : job.configurations) {
    const Size size = parse_size(c.size.empty() ? job.size : c.size);
    sum += double(size.width_px) * size.height_px * (job.frames + 3);
  }
  return sum + 1e5;
}

std::string label(const Job& job) {
  std::string text = job.experiment;
  if (!job.part.empty()) text += " " + job.part;
  text += " " + job.scene.name;
  if (job.configurations.size() == 1) text += " (" + job.configurations[0].name + ")";
  return text;
}

std::string duration_text(double s) {
  return s < 90.0 ? fmt::format("{:.0f} s", s) : fmt::format("{:.0f} min", s / 60.0);
}

}  // namespace

std::string Measured::reason() const {
  if (result.is_null()) return "not measured until now";
  return result.value("failed", "");
}

size_t Measured::failed_configurations() const {
  if (!works()) return 0;
  const json all = result.value("configurations", json::array());
  return static_cast<size_t>(std::count_if(all.begin(), all.end(), [](const json& c) {
    const auto items = c.items();
    return !c.contains("inapplicable") &&
           std::any_of(items.begin(), items.end(), [](const auto& item) { return item.key().ends_with("failed"); });
  }));
}

fs::path result_path(const Job& job, const fs::path& folder) {
  std::string name = job.part.empty() ? "" : short_word(job.part) + ".";
  name += file_word(job.scene.name);
  if (job.settings.value("process_each", false)) name += "." + short_word(job.configurations.at(0).name);
  return folder / "runs" / short_word(job.experiment) / (name + ".json");
}

std::vector<Measured> run_jobs(const std::vector<Job>& jobs, const RunOptions& options, const json& made,
                               const std::function<void(const std::vector<Measured>&)>& after) {
  std::vector<Measured> all;
  double work = 0.0;
  for (const Job& job : jobs) {
    Measured& m = all.emplace_back(Measured{job, nullptr});
    if (options.resume) m.result = result_there(job, options.folder, made);
    if (m.result.is_null()) work += weight(job);
  }
  Runner runner(options, made);
  runner.clean_up();
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed_s = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  double done = 0.0;
  for (size_t i = 0; i < all.size() && !interrupted(); ++i) {
    Measured& m = all[i];
    if (!m.result.is_null()) continue;
    const double before_s = elapsed_s();
    m.result = runner.run(m.job);
    if (m.result.is_null()) break;
    done += weight(m.job);
    const double now_s = elapsed_s();
    std::string line = fmt::format("[{}/{}] {}: {:.1f} s", i + 1, all.size(), label(m.job), now_s - before_s);
    if (!m.works()) line += ", failed: " + m.reason();
    if (done < work) line += fmt::format("; about {} left", duration_text(now_s * (work - done) / done));
    fmt::print(stderr, "{}\n", line);
    after(all);
  }
  return all;
}

}  // namespace izb::bench
