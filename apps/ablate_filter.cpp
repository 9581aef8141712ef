#include <spdlog/spdlog.h>

#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>

#include "apps/ablate_suites.hpp"
#include "apps/filter_plan.hpp"
#include "apps/output_folder.hpp"
#include "apps/progress.hpp"
#include "apps/ranks.hpp"
#include "apps/unfinished_work.hpp"
#include "datasets/io/atomic_file.hpp"
#include "eval/filter_summary.hpp"
#include "eval/lost_summary.hpp"
#include "registration/network_predictor.hpp"

namespace sketchloc {
namespace {

std::string run_file_of(const AblateOptions& options, const FilterPlan& plan) {
  return run_file_text(description_of(options, suite_config(plan.params)));
}

/// The plan's pieces as work for all processes; none of them wanted yet.
TextWork work_of(const AblateOptions& options, const FilterPlan& plan) {
  return {.what = run_file_of(options, plan) + fingerprints_of(options, plan),
          .pieces = {},
          .hire =
              [&plan] {
                return [&plan, worker = std::make_shared<FilterWorker>(plan)](std::size_t i) {
                  return trial_json(worker->run(plan.pieces.at(i)));
                };
              },
          .keep = {}};
}

/// Of a piece. Throws std::runtime_error where the text is of another one.
FilterTrial trial_of(const FilterPlan& plan, const FilterPlan::Piece& piece,
                     const std::string& text) {
  FilterTrial trial = trial_from_json(text);
  if (trial.set != plan.tasks.at(piece.task).set ||
      trial.method != plan.methods.at(piece.method).name || trial.seed != piece.seed) {
    throw std::runtime_error("the unfinished piece " + plan.name_of(piece) + " is of another run");
  }
  return trial;
}

/// The results of all pieces, as JSON lines: those that are kept, and the others.
std::vector<std::string> run(const FilterPlan& plan, TextWork work, Ranks& ranks,
                             UnfinishedWork& unfinished, unsigned jobs) {
  std::vector<std::string> lines(plan.pieces.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (std::optional<std::string> kept = unfinished.find(plan.name_of(plan.pieces[i]))) {
      lines[i] = *std::move(kept);
    } else {
      work.pieces.push_back(i);
    }
  }
  work.keep = [&](std::size_t i, const std::string& line) {
    unfinished.keep(plan.name_of(plan.pieces.at(i)), line);
    lines[i] = line;
  };
  Progress progress("ablate", lines.size());
  const std::size_t kept = lines.size() - work.pieces.size();
  ranks.lead(work, jobs, [&](std::size_t done) { progress.update(kept + done); });
  return lines;
}

std::string caption_of(const AblateOptions& options, const FilterPlan& plan) {
  return std::to_string(plan.tasks.size()) + " runs, " + std::to_string(options.seeds) +
         " seeds of the filter on each, seed " + std::to_string(options.seed) +
         "; with matched odometry, from the reference's first pose unless the kind says otherwise.";
}

void lead(const AblateOptions& options, Ranks& ranks) {
  OutputFolder out(options.out, options.force);
  const FilterPlan plan = filter_plan(options);
  const TextWork work = work_of(options, plan);
  UnfinishedWork unfinished(options.out, work.what);
  std::vector<FilterTrial> trials;
  std::string lines;
  for (const std::string& line : run(plan, work, ranks, unfinished, options.jobs)) {
    trials.push_back(trial_of(plan, plan.pieces[trials.size()], line));
    lines += line;
  }
  const std::vector<FilterRow> rows = summarize_filter(trials, options.seed);
  const std::vector<FilterDifference> differences =
      compare_filter(trials, plan.methods.back().name, options.seed);
  write_atomically(
      out / "report.html",
      filter_page_html("Ablation: " + options.suite, caption_of(options, plan), rows, differences));
  write_atomically(out / "metrics.json", filter_json(rows, differences));
  const std::vector<LostRow> lost = summarize_lost(trials);
  write_atomically(out / "lost.json", lost_json(lost));
  write_atomically(out / "trials.jsonl", lines);
  write_atomically(out / "run.yaml", run_file_of(options, plan));
  out.commit();
  unfinished.finish();
  std::cout << filter_markdown(rows) << "\n"
            << lost_markdown(lost) << "report: " << (out.target() / "report.html").string() << "\n";
}

/// What goes wrong here is said by the first process.
void follow(const AblateOptions& options, Ranks& ranks) {
  spdlog::set_level(spdlog::level::off);
  try {
    const FilterPlan plan = filter_plan(options);
    ranks.follow(work_of(options, plan), options.jobs);
  } catch (const std::exception& error) {
    ranks.fail(error.what());
  }
}

}  // namespace

void run_filter_suite(const AblateOptions& options) {
  run_networks_on_one_thread();
  Ranks ranks;
  if (ranks.leads()) {
    lead(options, ranks);
  } else {
    follow(options, ranks);
  }
}

}  // namespace sketchloc
