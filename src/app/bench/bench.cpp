// SPDX-License-Identifier: MIT
// izb bench: the paper's tables and figures, measured.
#include <CLI/CLI.hpp>

#include "app/bench/machine.h"
#include "app/bench/measures.h"
#include "app/bench/process.h"
#include "app/bench/report.h"
#include "app/bench/report_table.h"
#include "app/bench/sections.h"
#include "app/bench/sweep.h"
#include "app/commands.h"
#include "app/results.h"
#include "base/error.h"
#include "base/file.h"
#include "base/json_text.h"
#include "base/log.h"

namespace izb {
namespace {

namespace fs = std::filesystem;
using namespace bench;
using nlohmann::json;

struct BenchOptions {
  SweepRequest request;
  RunOptions run;
  std::string output;
  bool quick = false, complete = false, resume = false, list = false;
  int time_limit_s = 1800;
  Arguments arguments;
};

/// Removes the tables of the report that is there which the next one does not have: they would stand beside it as if
/// they were its.
void remove_other_tables(const fs::path& folder, const std::map<std::string, std::string>& tables) {
  std::error_code error;
  if (!fs::exists(folder / "report.json", error)) return;
  const json old = json::parse(read_text_file(folder / "report.json"), nullptr, false);
  try {
    for (const json& section : old.at("sections"))
      for (const json& table : section.at("tables")) {
        const std::string name = table.at("id").get<std::string>() + ".csv";
        if (!tables.contains(name) && name.find('/') == std::string::npos) fs::remove(folder / name, error);
      }
  } catch (const json::exception&) {  // no report of ours
  }
}

/// Writes everything that is made from the results: at any moment it says what has been measured until then.
void write_reports(const fs::path& folder, const json& document) {
  std::map<std::string, std::string> tables;
  for (const json& section : document["sections"])
    for (const json& table : section["tables"]) tables[table["id"].get<std::string>() + ".csv"] = csv_of(table);
  remove_other_tables(folder, tables);
  for (const auto& [name, text] : tables) write_file_atomically(folder / name, text);
  write_file_atomically(folder / "report.json", json_text(document, 1) + "\n");
  write_file_atomically(folder / "report.html", make_report(document, folder));
}

void print_plan(const std::vector<Job>& jobs) {
  for (const Job& job : jobs) {
    fmt::print("{}{}{}: {}, {}, {} frame{}, {} configuration{}\n", job.experiment, job.part.empty() ? "" : " ",
               job.part, job.scene.name, job.size, job.frames, job.frames == 1 ? "" : "s", job.configurations.size(),
               job.configurations.size() == 1 ? "" : "s");
    for (const Configuration& c : job.configurations)
      fmt::print("  {}: {}{}\n", c.name, c.command_line(), c.size.empty() ? "" : " --size " + c.size);
  }
}

void prepare_folder(const BenchOptions& o) {
  std::error_code error;
  if (!o.resume && fs::exists(o.run.folder / "runs", error))
    fail("'{}' holds results already: --resume goes on with them, or choose another folder", o.output);
  fs::create_directories(o.run.folder, error);
  if (!error) fs::create_directories(o.run.folder / "images", error);
  if (error) fail("cannot make the folder '{}': {}", o.output, error.message());
}

int run_bench(BenchOptions& o) {
  if (o.quick && o.complete) throw UsageError("--quick and --complete exclude each other");
  o.request.extent = o.quick ? Extent::quick : o.complete ? Extent::complete : Extent::full;
  o.run.folder = o.output;
  o.run.resume = o.resume;
  o.run.time_limit_s = o.time_limit_s;
  if (!o.request.size.empty()) parse_size(o.request.size);
  auto& wanted = o.request.experiments;
  if (std::find(wanted.begin(), wanted.end(), "all") != wanted.end()) wanted.clear();
  const json paper = read_bench_data("paper.json");
  const std::vector<Job> jobs =
      plan(read_bench_data("sweeps.json"), read_bench_data("views.json"), o.request, o.run.folder);
  if (o.list) {
    print_plan(jobs);
    return 0;
  }
  if (o.output.empty()) throw UsageError("nowhere to write: give -o FOLDER");
  if (jobs.empty()) throw UsageError("nothing to measure");
  prepare_folder(o);
  const FolderLock lock(o.run.folder);
  o.run.alone = lock.held();
  const json made = made_json(Gl(o.request.context));
  const std::string command = origin_json(o.arguments)["command"];
  const std::string extent = o.quick      ? "quick: small pictures and scenes"
                             : o.complete ? "complete"
                                          : "full: a part of the scenes and frames";
  const auto report = [&](const std::vector<Measured>& all) {
    write_reports(o.run.folder, make_document(all, paper, made, command, extent));
  };
  catch_interrupts();
  const std::vector<Measured> all = run_jobs(jobs, o.run, made, report);
  report(all);
  size_t failed = 0, configurations = 0;
  for (const Measured& m : all) failed += !m.works(), configurations += m.failed_configurations();
  if (interrupted()) {
    note("interrupted: '{}' holds what was measured; --resume goes on", o.output);
    return 1;
  }
  fmt::print("wrote {}\n", (o.run.folder / "report.html").string());
  if (failed > 0) note("{} of {} jobs failed: the report says why", failed, all.size());
  if (configurations > 0)
    note("{} configuration{} could not be measured: the report says why", configurations,
         configurations == 1 ? "" : "s");
  return failed + configurations > 0 ? 1 : 0;
}

}  // namespace

Command add_bench(CLI::App& app, const Arguments& arguments) {
  auto o = std::make_shared<BenchOptions>();
  o->arguments = arguments;
  CLI::App* sub = app.add_subcommand("bench", "Measure the paper's tables and figures, and what stands beside them");
  std::vector<std::string> names{"all"};
  names.insert(names.end(), std::begin(experiment_names), std::end(experiment_names));
  sub->add_option("WHAT", o->request.experiments, "which tables and figures, or all")
      ->required()
      ->check(CLI::IsMember(names));
  sub->add_option("-o,--output", o->output, "the folder for results, tables and the report")->type_name("FOLDER");
  sub->add_option("--scenes", o->request.scenes,
                  "files, folders of files, or names of procedural scenes, instead of those of the sweeps")
      ->type_name("SCENE...");
  sub->add_flag("--quick", o->quick, "small pictures and scenes: minutes");
  sub->add_flag("--complete", o->complete, "every scene, every frame: hours");
  sub->add_flag("--resume", o->resume,
                "go on with the results in the folder that were measured under the same conditions");
  sub->add_flag("--list", o->list, "only say what would be measured");
  OptionSet set;
  set.text("size", o->request.size, "WIDTHxHEIGHT",
           "the picture's size, instead of that of the sweeps; where the sweep is over sizes, its own stay");
  set.integer("frames", o->request.frames, 0, 100000, "frames", "frames to time, 0: as in the sweeps");
  set.integer("time-limit", o->time_limit_s, 1, 1000000, "seconds", "after which a scene's job is given up");
  set.choice("context", o->request.context, gpu::context_names(), "how to get an OpenGL 4.5 context");
  set.add_to(*sub, "Options");
  return [o] { return run_bench(*o); };
}

Command add_bench_job(CLI::App& app) {
  struct Values {
    std::string job, output;
  };
  auto o = std::make_shared<Values>();
  CLI::App* sub = app.add_subcommand("bench-job", "One job of izb bench, in this process");
  sub->group("");  // not in the help: bench starts it
  sub->add_option("JOB", o->job)->required();
  sub->add_option("RESULT", o->output)->required();
  return [o] {
    AtomicFile file(o->output);
    const json job = json::parse(o->job, nullptr, false);
    if (job.is_discarded()) throw UsageError("JOB is not JSON");
    const json result = run_job(job_from(job), fs::path(o->output).parent_path().parent_path().parent_path());
    const std::string text = json_text(result, 1) + "\n";
    file.write(std::as_bytes(std::span(text)));
    file.commit();
    return 0;
  };
}

}  // namespace izb
