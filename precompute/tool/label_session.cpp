// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/label_session.h"

#include <algorithm>
#include <numeric>

#include "tool/pictures.h"

namespace vsprite {
namespace {

Classifier fit_all(const LabelledPairs& pairs) {
  std::vector<int> all(pairs.labels.size());
  std::iota(all.begin(), all.end(), 0);
  return fit_classifier(pairs, all, measure_spread(pairs.vectors), {});
}

/// Agreement of every guess with its answer, also of those that were given again since.
void count_guesses(const std::vector<Answer>& answers, LabelProgress& progress) {
  progress.agreed = progress.guessed = 0;
  for (const Answer& answer : answers) {
    if (answer.guess < 0) continue;
    ++progress.guessed;
    progress.agreed += (answer.guess <= 1) == answer.acceptable;
  }
}

}  // namespace

LabelSession::LabelSession(const Project& project, const SampleNames& names, LabelStore& store,
                           FeatureSet set)
    : project_(&project), names_(&names), store_(&store), set_(std::move(set)) {}

Result<LabelSession> LabelSession::open(const Project& project, const SampleNames& names,
                                        LabelStore& store, const Settings& settings) {
  auto sprites = load_sprites(project);
  if (!sprites) return sprites.error();
  LabelSession session(project, names, store, std::move(sprites->features));
  session.config_.seed = settings.seed;
  session.progress_.goal = settings.questions;
  const Settings defaults;
  session.film_ =
      measure_pairs(session.set_, bootstrap_labels(session.set_, defaults.pairs, settings.seed));
  if (auto both = check_labels(session.set_, session.film_.labels, {}); !both)
    return Error{both.error().code, project.folder() + ": " + both.error().message};
  session.pool_ = draw_pool(session.set_, fit_all(session.film_), session.config_);
  for (std::size_t k = 0; k < session.pool_.size(); ++k)
    session.in_pool_[{session.pool_[k].i, session.pool_[k].j}] = static_cast<int>(k);
  session.skipped_.assign(session.pool_.size(), 0);
  if (auto learned = session.learn(); !learned) return learned.error();
  session.ask();
  return session;
}

/// From everything that is in the store now.
Result<void> LabelSession::learn() {
  const auto answers = store_->answers();
  if (!answers) return answers.error();
  const PersonLabels person = resolve(*answers, *names_);
  LabelledPairs pairs;
  const std::vector<Label> merged = merge_labels(film_.labels, person);
  // What is left of the film's labels keeps its order: their features need no second look.
  std::size_t film = 0;
  for (const Label& label : merged) {
    pairs.labels.push_back(label);
    if (label.by_person) {
      pairs.vectors.push_back(vsprite::features(set_, label.i, label.j));
      continue;
    }
    while (film_.labels[film].i != label.i || film_.labels[film].j != label.j) ++film;
    pairs.vectors.push_back(film_.vectors[film]);
  }
  classifier_ = fit_all(pairs);
  answered_.assign(pool_.size(), 0);
  progress_.smooth = progress_.jumps = 0;
  for (const Label& label : person.labels) {
    ++(label.acceptable ? progress_.smooth : progress_.jumps);
    const auto found = in_pool_.find({label.i, label.j});
    if (found != in_pool_.end()) answered_[static_cast<std::size_t>(found->second)] = 1;
  }
  progress_.random = person.guesses;
  count_guesses(*answers, progress_);
  return {};
}

void LabelSession::ask() {
  current_.reset();
  std::vector<std::uint8_t> used = answered_;
  for (std::size_t k = 0; k < used.size(); ++k) used[k] |= skipped_[k];
  const auto asked = static_cast<int>(std::count(used.begin(), used.end(), 1));
  const Question question = next_question(pool_, used, asked, classifier_, config_);
  if (question.candidate < 0) return;
  const Candidate& candidate = pool_[static_cast<std::size_t>(question.candidate)];
  current_ = ShownPair{candidate.i, candidate.j, question.distance, question.at_random, {}};
}

Result<void> LabelSession::answer(bool smooth) {
  const ShownPair& pair = *current_;
  const Answer given{names_->name(pair.i), names_->name(pair.j), smooth, pair.at_random,
                     double{pair.distance}};
  if (auto added = store_->add({&given, 1}); !added) return added;
  if (auto learned = learn(); !learned) return learned;
  ++progress_.answered;
  ask();
  return {};
}

void LabelSession::skip() {
  if (!current_) return;
  const auto found = in_pool_.find({current_->i, current_->j});
  if (found != in_pool_.end()) skipped_[static_cast<std::size_t>(found->second)] = 1;
  ask();
}

/// The pair of an answer that was taken back, with the guess of now.
void LabelSession::show_again(const Answer& answer) {
  const auto a = names_->find(answer.a), b = names_->find(answer.b);
  if (!a || !b || *a == *b) return ask();  // about samples that are gone: nothing to show
  const int i = std::min(*a, *b), j = std::max(*a, *b);
  const float distance = classifier_.distance(vsprite::features(set_, i, j));
  current_ = ShownPair{i, j, distance, answer.at_random, answer.acceptable};
}

Result<bool> LabelSession::undo() {
  const auto undone = store_->undo();
  if (!undone) return undone.error();
  if (!*undone) return false;
  if (auto learned = learn(); !learned) return learned.error();
  progress_.answered = std::max(0, progress_.answered - 1);
  show_again(**undone);
  return true;
}

Result<bool> LabelSession::redo() {
  const auto redone = store_->redo();
  if (!redone) return redone.error();
  if (!*redone) return false;
  if (auto learned = learn(); !learned) return learned.error();
  ++progress_.answered;
  ask();
  return true;
}

Result<Image> LabelSession::picture(int sample) const {
  return read_sprite(*project_, set_.rows[static_cast<std::size_t>(sample)]);
}

}  // namespace vsprite
