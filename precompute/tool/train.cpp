// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/train.h"

#include <algorithm>
#include <cstdio>

#include "tool/report.h"
#include "tool/stages.h"

namespace vsprite {
namespace {

constexpr double kUsualMoves[] = {0.5, 0.75, 1, 1.25, 1.5};
constexpr double kRocLines[] = {0.25, 0.5, 0.75, 1, 1.25, 1.5, 2, 3};

TrainConfig config_of(const Settings& settings) {
  TrainConfig config;
  config.folds = settings.folds;
  config.false_accept_cost = settings.false_accept_cost;
  return config;
}

double saved_move(const Project& project) {
  const auto text = read_file(project.path("classifier.toml"));
  double moved = 1;
  if (text && !parse_classifier(*text, "", &moved)) moved = 1;  // the stage says what is wrong
  return moved;
}

struct Learned {
  FolderLabels labels;
  Training training;
};

Result<Learned> learn(const Project& project, const FeatureSet& set, const Settings& settings) {
  auto labels = folder_labels(project, set, settings.pairs, settings.seed);
  if (!labels) return labels.error();
  auto training = train(set, labels->labels, config_of(settings));
  if (!training)
    return Error{training.error().code, project.folder() + ": " + training.error().message};
  return Learned{std::move(*labels), std::move(*training)};
}

/// The last point of the curve that lies at or below `at`.
RocPoint roc_at(const HeldOut& checked, double at) {
  RocPoint found{at, 0, 0};
  for (const RocPoint& point : checked.roc)
    if (point.at <= at)
      found.accepted_good = point.accepted_good, found.accepted_bad = point.accepted_bad;
  return found;
}

Json confusion_json(const Confusion& c) {
  return {{"true_accept", c.true_accept},
          {"false_accept", c.false_accept},
          {"true_reject", c.true_reject},
          {"false_reject", c.false_reject}};
}

Json estimate_json(const FalseAccepts& e) {
  return {{"accepted", e.accepted},
          {"wrong", e.wrong},
          {"refused", e.refused},
          {"missed", e.missed},
          {"likely_at_most", likely_at_most(e.wrong, e.accepted)}};
}

Json answers_json(const PersonLabels& person) {
  return {{"given", person.answers},
          {"used", person.labels.size()},
          {"gone", person.gone},
          {"repeated", person.repeated},
          {"disagreeing", person.disagreeing}};
}

Json result_json(const Learned& learned, double move, double film_labels_worth) {
  const Training& t = learned.training;
  const HeldOut& checked = t.checked;
  int acceptable = 0, by_person = 0;
  for (const Label& label : learned.labels.labels)
    acceptable += label.acceptable, by_person += label.by_person;
  Json weights = Json::object(), spread = Json::object(), roc = Json::array();
  for (std::size_t k = 0; k < kFeatureCount; ++k) {
    weights[kFeatureNames[k]] = t.classifier.weights[k];
    spread[kFeatureNames[k]] = {{"mean", checked.weight_mean[k]}, {"sd", checked.weight_sd[k]}};
  }
  for (const double at : kRocLines) {
    const RocPoint point = roc_at(checked, at);
    roc.push_back(
        {{"at", at}, {"accepted_good", point.accepted_good}, {"accepted_bad", point.accepted_bad}});
  }
  Json out{{"labels", learned.labels.labels.size()},
           {"acceptable", acceptable},
           {"by_person", by_person},
           {"threshold", t.classifier.threshold},
           {"weights", weights},
           {"weight_shares", spread},
           {"confusion", confusion_json(checked.all)},
           {"folds", checked.folds},
           {"roc_area", checked.roc_area},
           {"roc_by_person", checked.roc_by_person},
           {"roc", roc}};
  if (move != 1) out["moved"] = move;
  if (learned.labels.person.answers > 0) {
    out["answers"] = answers_json(learned.labels.person);
    out["confusion_by_person"] = confusion_json(checked.person);
    out["film_labels_worth"] = film_labels_worth;
    out["false_accepts"] =
        estimate_json(estimate_false_accepts(learned.labels.labels, checked, move));
  }
  out["label_warnings"] = t.warnings;
  return out;
}

std::string percent(double share, int decimals) { return fixed_text(100 * share, decimals) + " %"; }

}  // namespace

double move_of(const Project& project, const Settings& settings) {
  return settings.threshold > 0 ? settings.threshold : saved_move(project);
}

Result<void> add_labels_to_key(const Project& project, const Settings& settings, StageKey& key) {
  if (const double move = move_of(project, settings); move != 1) key.settings["threshold"] = move;
  const auto rows = project.samples();
  if (!rows) return rows.error();
  const auto names = SampleNames::of(project, *rows);
  if (!names) return names.error();
  const auto person = read_person_labels(project, *names);
  if (!person) return person.error();
  if (person->labels.empty()) return {};
  std::string text;
  for (const Label& l : person->labels)
    text += std::to_string(l.i) + "," + std::to_string(l.j) + (l.acceptable ? ",1" : ",0") +
            (l.at_random ? ",1\n" : ",0\n");
  key.inputs["answers"] = hex64(hash_bytes(text));
  return {};
}

Result<Json> train_folder(const Project& project, const FeatureSet& set, const Settings& settings) {
  const double move = move_of(project, settings);
  const auto learned = learn(project, set, settings);
  if (!learned) return learned.error();
  const std::string text = format_classifier(learned->training, move);
  if (auto wrote = write_file(project.path("roc.svg"), roc_svg(learned->training.checked)); !wrote)
    return wrote.error();
  if (auto wrote = write_file(project.path("classifier.toml"), text); !wrote) return wrote.error();
  return result_json(*learned, move, config_of(settings).film_labels_worth);
}

Result<MovePreview> preview_move(const Project& project, const FeatureSet& set,
                                 const Settings& settings) {
  const auto learned = learn(project, set, settings);
  if (!learned) return learned.error();
  const HeldOut& checked = learned->training.checked;
  MovePreview preview;
  preview.saved = saved_move(project);
  preview.asked = settings.threshold > 0 ? settings.threshold : preview.saved;
  preview.by_person = checked.roc_by_person;
  std::vector<double> moves(std::begin(kUsualMoves), std::end(kUsualMoves));
  moves.insert(moves.end(), {preview.saved, preview.asked});
  std::sort(moves.begin(), moves.end());
  moves.erase(std::unique(moves.begin(), moves.end()), moves.end());

  Classifier widest = learned->training.classifier;
  widest.threshold *= moves.back();
  const auto all = accepted_pairs(set, widest, settings.jobs);
  const TransitionConfig config = transition_config(settings);
  for (const double move : moves) {
    MoveRow row;
    row.move = move;
    std::vector<PairDistance> pairs;
    const auto scale = static_cast<float>(moves.back() / move);
    for (const PairDistance& p : all)
      if (p.distance * scale <= 1) pairs.push_back({p.i, p.j, p.distance * scale});
    TransitionStats stats;
    const auto costs = make_cost_table(set, pairs, config, stats);
    row.accepted = pairs.size();
    row.transitions = costs ? stats.transitions : 0;
    row.kept = costs ? stats.kept : 0;
    const RocPoint point = roc_at(checked, move);
    row.accepted_good = point.accepted_good, row.accepted_bad = point.accepted_bad;
    row.random = estimate_false_accepts(learned->labels.labels, checked, move);
    preview.rows.push_back(row);
  }
  return preview;
}

std::string move_text(const MovePreview& preview) {
  std::string out =
      "  threshold   pairs accepted   transitions   samples kept   jumps let through   smooth "
      "missed\n";
  for (const MoveRow& row : preview.rows) {
    char line[160];
    std::snprintf(line, sizeof line, "%c %9g %16llu %13llu %14d %19s %15s%s\n",
                  row.move == preview.asked ? '>' : ' ', row.move,
                  static_cast<unsigned long long>(row.accepted),
                  static_cast<unsigned long long>(row.transitions), row.kept,
                  percent(row.accepted_bad, 2).c_str(), percent(1 - row.accepted_good, 1).c_str(),
                  row.move == preview.saved ? "   <- as it is" : "");
    out += line;
  }
  out += preview.by_person
             ? "  shares of a person's answers, each judged by a classifier that did not see its "
               "frames\n"
             : "  shares of the film's own labels (no person's answers yet), each judged by a "
               "classifier that did\n  not see its frames\n";
  for (const MoveRow& row : preview.rows)
    if (row.move == preview.asked && row.random.accepted > 0)
      out += "  of the pairs accepted at " + fixed_text(row.move, 2) + ", " +
             std::to_string(row.random.wrong) + " of " + std::to_string(row.random.accepted) +
             " drawn at random were called a visible jump: at most " +
             percent(likely_at_most(row.random.wrong, row.random.accepted), 1) +
             " in the film (95 % sure)\n";
  return out;
}

Json move_json(const MovePreview& preview) {
  Json rows = Json::array();
  for (const MoveRow& row : preview.rows)
    rows.push_back({{"threshold", row.move},
                    {"accepted", row.accepted},
                    {"transitions", row.transitions},
                    {"kept", row.kept},
                    {"accepted_bad", row.accepted_bad},
                    {"accepted_good", row.accepted_good},
                    {"false_accepts", estimate_json(row.random)}});
  return {{"thresholds", rows},
          {"asked", preview.asked},
          {"saved", preview.saved},
          {"by_person", preview.by_person},
          {"written", false}};
}

std::string roc_svg(const HeldOut& checked) {
  constexpr double kLeft = 60, kTop = 40, kSide = 370;
  const auto x = [&](double bad) { return fixed_text(kLeft + kSide * bad, 1); };
  const auto y = [&](double good) { return fixed_text(kTop + kSide * (1 - good), 1); };
  std::string out =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"480\" height=\"480\" "
      "font-family=\"sans-serif\" font-size=\"13\" fill=\"#24303a\">\n"
      "<rect width=\"480\" height=\"480\" fill=\"#ffffff\"/>\n";
  for (int k = 0; k <= 4; ++k) {
    const double at = k / 4.0;
    out += "<path d=\"M" + x(0) + " " + y(at) + "H" + x(1) + "M" + x(at) + " " + y(0) + "V" + y(1) +
           "\" stroke=\"#dfe5ea\" fill=\"none\"/>\n<text x=\"" + x(at) + "\" y=\"" +
           fixed_text(kTop + kSide + 18, 0) + "\" text-anchor=\"middle\">" +
           std::to_string(25 * k) + "</text>\n<text x=\"" + fixed_text(kLeft - 8, 0) + "\" y=\"" +
           y(at) + "\" text-anchor=\"end\" dy=\"4\">" + std::to_string(25 * k) + "</text>\n";
  }
  out += "<path d=\"M" + x(0) + " " + y(0) + "L" + x(1) + " " + y(1) +
         "\" stroke=\"#9aa7b0\" stroke-dasharray=\"4 4\"/>\n<polyline fill=\"none\" "
         "stroke=\"#d9622b\" stroke-width=\"2.5\" points=\"";
  for (const RocPoint& point : checked.roc)
    out += x(point.accepted_bad) + "," + y(point.accepted_good) + " ";
  const RocPoint line = roc_at(checked, 1);
  out += "\"/>\n<circle cx=\"" + x(line.accepted_bad) + "\" cy=\"" + y(line.accepted_good) +
         "\" r=\"5\" fill=\"#1f6f8b\"/>\n<text x=\"" +
         fixed_text(kLeft + kSide * line.accepted_bad + 10, 1) + "\" y=\"" +
         fixed_text(kTop + kSide * (1 - line.accepted_good) + 22, 1) +
         "\" fill=\"#1f6f8b\">D = 1: " + percent(line.accepted_good, 1) + " of the smooth, " +
         percent(line.accepted_bad, 2) + " of the jumps</text>\n<text x=\"" + x(0) +
         "\" y=\"24\" font-size=\"15\">held-out pairs, labelled by " +
         (checked.roc_by_person ? "a person" : "the film itself") + "; area " +
         fixed_text(checked.roc_area, 4) + "</text>\n<text x=\"" + x(0.5) +
         "\" y=\"466\" text-anchor=\"middle\">visible jumps accepted, %</text>\n<text "
         "transform=\"translate(18 " +
         y(0.5) +
         ") rotate(-90)\" text-anchor=\"middle\">smooth pairs accepted, %</text>\n</svg>\n";
  return out;
}

}  // namespace vsprite
