// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/cast.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "film/match.h"
#include "film/source.h"
#include "tool/shadows.h"

namespace vsprite {
namespace {

namespace fs = std::filesystem;

constexpr double kSegmented = 0.9;  // share of the time, for the progress bar
constexpr int kTogether = 64;       // pictures in memory

/// One clip, segmented.
struct Member {
  const CastClip* clip = nullptr;
  Project project;
  Json result;
  std::vector<SampleRow> rows;
  std::vector<ShadowRow> shadows;
  Rate rate;
  MeanColor color;
  Matching matching;
};

std::string folder_of(std::size_t index, const CastClip& clip) {
  std::string digits = std::to_string(index);
  if (digits.size() < 2) digits.insert(0, 1, '0');
  std::string name = clip.tag.empty() ? fs::path(clip.file).stem().string() : clip.tag;
  std::replace(name.begin(), name.end(), '/', '-');
  return digits + "-" + name;
}

/// Folders of clips that the cast does not hold any more.
void remove_others(const std::string& folder, const std::set<std::string>& wanted) {
  std::error_code error;
  std::vector<fs::path> others;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (wanted.count(at->path().filename().string()) == 0) others.push_back(at->path());
  for (const fs::path& other : others) fs::remove_all(other, error);
}

bool ends_everything(ErrorCode code) {
  return code == ErrorCode::CannotWrite || code == ErrorCode::CannotCreate ||
         code == ErrorCode::InUse || code == ErrorCode::OutOfMemory ||
         code == ErrorCode::Interrupted;
}

/// Rows of a finished folder as they stand there, and how they look.
Result<void> read_member(Member& member) {
  auto rows = member.project.samples();
  if (!rows) return rows.error();
  const auto film = member.project.film();
  if (!film) return film.error();
  member.rate = {film->fps_numerator, film->fps_denominator};
  member.rows = std::move(*rows);
  auto shadows = read_shadows(member.project);
  if (!shadows) return shadows.error();
  member.shadows = std::move(*shadows);
  PictureReader reader(member.project, member.rows);
  for (std::size_t i = 0; i < member.rows.size(); ++i) {
    const auto picture = reader.picture(static_cast<int>(i));
    if (!picture) return picture.error();
    member.color.add(*picture);
  }
  return {};
}

/// The film frame after the last that was read; of a draft up to one more.
int film_end(const Member& member) { return member.clip->first + member.result.value("frames", 0); }

Result<void> check_events(const Member& member) {
  const int end = film_end(member);
  for (const CastEvent& event : member.clip->events)
    if (event.frame >= end)
      return Error{ErrorCode::BadContent, event.at + ": events: `" + event.name + "` at frame " +
                                              std::to_string(event.frame) + ", the last of " +
                                              member.clip->file + " is " + std::to_string(end - 1)};
  return {};
}

/// Clip `index` of `count` in its own folder.
Result<Member> segment_member(StageRun& run, const CastClip& clip, std::size_t index,
                              std::size_t count) {
  const std::string folder = run.project.path("clips/" + folder_of(index, clip));
  auto project = Project::open(folder, true);
  if (!project) return project.error();
  Member member{&clip, std::move(*project), {}, {}, {}, {}, {}, {}};
  const Settings own = clip_settings(run.settings, clip);
  StageListener listener;
  const std::string name = clip.tag.empty() ? clip.file : clip.tag;
  if (run.listener.note)
    listener.note = [&run, name](const std::string& text) {
      run.listener.note(name + ": " + text);
    };
  if (run.listener.progress)
    listener.progress = [&run, index, count](double share) {
      run.listener.progress(kSegmented * (static_cast<double>(index) + share) /
                            static_cast<double>(count));
    };
  StageRun part{member.project, own, clip.path, {}, listener};
  part.first_frame = clip.first;
  part.end_frame = clip.last == INT_MAX ? INT_MAX : clip.last + 1;
  const auto outcomes = run_stages(part, 0, 0);
  if (!outcomes) return outcomes.error();
  member.result = outcomes->front().result;
  if (auto fits = check_events(member); !fits) return fits.error();
  if (auto read = read_member(member); !read) return read.error();
  return member;
}

Result<std::vector<Member>> segment_members(StageRun& run, const std::vector<CastClip>& clips) {
  std::set<std::string> wanted;
  for (std::size_t k = 0; k < clips.size(); ++k) wanted.insert(folder_of(k, clips[k]));
  if (auto made = make_folder(run.project.path("clips")); !made) return made.error();
  remove_others(run.project.path("clips"), wanted);
  std::vector<Member> members;
  std::optional<Error> fault;
  for (std::size_t k = 0; k < clips.size(); ++k) {
    auto member = segment_member(run, clips[k], k, clips.size());
    if (!member && ends_everything(member.error().code)) return member.error();
    if (!member && !fault)
      fault = member.error();
    else if (!member && run.listener.note)
      run.listener.note(member.error().message);
    if (member) members.push_back(std::move(*member));
  }
  if (fault) return *fault;
  return members;
}

// ---- one sprite set ----

/// A picture of the set, and the picture that it is made of.
struct Origin {
  const Member* member = nullptr;
  int sample = 0;  ///< in the member's folder
};

struct CastRows {
  std::vector<SampleRow> rows;
  std::vector<Origin> origins;  ///< (rows)
  int clips = 0;
};

/// Image pixels per pixel of the first clip's film: the first clip's, where all fit.
double common_scale(const std::vector<Member>& members, int max_size) {
  double longest = 1;
  for (const Member& member : members)
    for (const SampleRow& row : member.rows)
      longest = std::max(longest, member.matching.scale * std::max(row.width, row.height));
  return std::min(members.front().rows.front().scale, (max_size - 1) / longest);
}

SampleRow matched(const SampleRow& row, const Member& member, double scale) {
  const double k = member.matching.scale;
  const auto rounded = [](double value) { return std::floor(value * 1000 + 0.5) / 1000; };
  SampleRow out = row;
  out.source = member.clip->file;
  out.tag = member.clip->tag;
  if (member.clip->velocity)
    out.velocity_x = (*member.clip->velocity)[0], out.velocity_y = (*member.clip->velocity)[1];
  out.velocity_x = rounded(k * out.velocity_x), out.velocity_y = rounded(k * out.velocity_y);
  if (k == 1 && row.scale == scale) return out;
  out.left = k * row.left, out.top = k * row.top;
  out.anchor_x = k * row.anchor_x, out.anchor_y = k * row.anchor_y;
  out.area = rounded(k * k * row.area);
  out.scale = scale;
  out.width = std::ceil(k * row.width * scale - 1e-6) / scale;
  out.height = std::ceil(k * row.height * scale - 1e-6) / scale;
  return out;
}

CastRows number_through(const std::vector<Member>& members, const Settings& settings) {
  CastRows cast;
  const double scale = common_scale(
      members, settings.draft ? std::min(settings.max_size, kDraftSize) : settings.max_size);
  std::vector<int> mirrored_samples;
  for (const Member& member : members) {
    int last = -1;
    for (const SampleRow& row : retimed(member.rows, member.rate, members.front().rate)) {
      SampleRow out = matched(row, member, scale);
      if (row.clip != last) last = row.clip, ++cast.clips;
      out.sample = static_cast<int>(cast.rows.size());
      out.clip = cast.clips - 1;
      if (member.clip->mirror.value_or(settings.mirror)) mirrored_samples.push_back(out.sample);
      cast.rows.push_back(std::move(out));
      cast.origins.push_back({&member, row.sample});
    }
  }
  int last = -1, mirrored_clips = 0;
  for (const int sample : mirrored_samples) {
    const SampleRow& row = cast.rows[static_cast<std::size_t>(sample)];
    if (row.clip != last) last = row.clip, ++mirrored_clips;
    cast.rows.push_back(
        mirrored(row, static_cast<int>(cast.rows.size()), cast.clips + mirrored_clips - 1));
  }
  cast.clips += mirrored_clips;
  return cast;
}

Result<std::vector<std::uint8_t>> picture_of(const Origin& origin, const SampleRow& row) {
  const Member& member = *origin.member;
  const SampleRow& old = member.rows[static_cast<std::size_t>(origin.sample)];
  auto picture = read_sprite(member.project, old);
  if (!picture) return picture.error();
  const double ratio = old.scale / (member.matching.scale * row.scale);
  if (ratio != 1 || member.matching.changes_color()) {
    const auto side = [&row](double length) {
      return static_cast<int>(std::lround(length * row.scale));
    };
    *picture = redrawn(*picture, ratio, side(row.width), side(row.height), member.matching.gain);
  }
  return encode_png(*picture);
}

/// The shadow of that picture, in the set's scale; nothing where it has none.
Result<std::vector<std::uint8_t>> shadow_of(const Origin& origin, const SampleRow& row,
                                            ShadowRow& shadow) {
  const Member& member = *origin.member;
  const auto found =
      std::lower_bound(member.shadows.begin(), member.shadows.end(), origin.sample,
                       [](const ShadowRow& of, int sample) { return of.sample < sample; });
  if (found == member.shadows.end() || found->sample != origin.sample)
    return std::vector<std::uint8_t>{};
  auto picture = read_shadow(member.project, *found);
  if (!picture) return picture.error();
  const SampleRow& old = member.rows[static_cast<std::size_t>(origin.sample)];
  const double ratio = old.scale / (member.matching.scale * row.scale);
  shadow = *found;
  shadow.sample = row.sample;
  if (ratio != 1) {
    constexpr double kNoGain[3] = {1, 1, 1};
    shadow.width = static_cast<int>(std::ceil(found->width / ratio - 1e-6));
    shadow.height = static_cast<int>(std::ceil(found->height / ratio - 1e-6));
    shadow.anchor_x = std::floor(1000 * found->anchor_x / ratio + 0.5) / 1000;
    shadow.anchor_y = std::floor(1000 * found->anchor_y / ratio + 0.5) / 1000;
    *picture = redrawn(*picture, ratio, shadow.width, shadow.height, kNoGain);
  }
  return encode_png(*picture);
}

Result<void> write_pictures(StageRun& run, const CastRows& cast) {
  Project& project = run.project;
  if (auto begun = project.begin_stage("segment"); !begun) return begun;
  std::error_code error;
  fs::remove(project.path("samples.csv"), error);
  fs::remove_all(project.path("sprites"), error);
  remove_shadows(project);
  if (run.settings.shadow)
    if (auto made = make_folder(project.path(kShadowFolder)); !made) return made.error();
  std::vector<ShadowRow> shadows;
  if (auto made = make_folder(project.path("sprites")); !made) return made.error();
  using Png = Result<std::vector<std::uint8_t>>;
  const std::size_t count = cast.origins.size();
  for (std::size_t begin = 0; begin < count; begin += kTogether) {
    const std::size_t size = std::min<std::size_t>(kTogether, count - begin);
    std::vector<Png> pictures(size, Png(std::vector<std::uint8_t>{})), shades = pictures;
    std::vector<ShadowRow> shade_rows(size);
    tbb::parallel_for(std::size_t{0}, size, [&](std::size_t k) {
      pictures[k] = picture_of(cast.origins[begin + k], cast.rows[begin + k]);
      shades[k] = shadow_of(cast.origins[begin + k], cast.rows[begin + k], shade_rows[k]);
    });
    std::vector<NamedBytes> files;
    for (std::size_t k = 0; k < size; ++k) {
      if (!pictures[k]) return pictures[k].error();
      if (!shades[k]) return shades[k].error();
      if (!shades[k]->empty()) {
        shadows.push_back(shade_rows[k]);
        files.push_back({shadow_path(project, shade_rows[k].sample), *shades[k]});
      }
      files.push_back({project.sprite_path(cast.rows[begin + k].sample), *pictures[k]});
    }
    if (auto wrote = write_files(files); !wrote) return wrote.error();
    if (run.listener.progress)
      run.listener.progress(kSegmented + (1 - kSegmented) * static_cast<double>(begin + size) /
                                             static_cast<double>(count));
  }
  if (run.settings.shadow)
    if (auto wrote = write_shadows(project, shadows); !wrote) return wrote;
  return sync_folder(project.path("sprites"));
}

// ---- the report ----

/// What of the clip does not come out as the cast says: a range beyond the film, events at frames
/// that were left out.
std::vector<std::string> cast_warnings(const Member& member, const CastRows& cast) {
  std::vector<std::string> out;
  const CastClip& clip = *member.clip;
  const int end = film_end(member);
  if (clip.last != INT_MAX && clip.last >= end)
    out.push_back("frames = [" + std::to_string(clip.first) + ", " + std::to_string(clip.last) +
                  "], but the film has " + std::to_string(end) + " frames");
  for (const CastEvent& event : clip.events) {
    int shown = -1;
    for (std::size_t i = 0; i < cast.origins.size(); ++i)
      if (cast.origins[i].member == &member && cast.rows[i].frame <= event.frame)
        shown = cast.rows[i].frame;
    const auto stands_for = [&event](const SampleRow& row) {
      return row.mirror_of < 0 && row.frame <= event.frame &&
             event.frame < row.frame + row.duration;
    };
    if (std::any_of(member.rows.begin(), member.rows.end(), stands_for)) continue;
    out.push_back("event `" + event.name + "`: frame " + std::to_string(event.frame) +
                  " was left out, " +
                  (shown < 0 ? "and all before it: it never happens"
                             : "it happens at frame " + std::to_string(shown)));
  }
  return out;
}

double frames_a_second(Rate rate) { return static_cast<double>(rate.numerator) / rate.denominator; }

Json events_json(const CastClip& clip) {
  Json list = Json::array();
  for (const CastEvent& event : clip.events)
    list.push_back({{"frame", event.frame}, {"name", event.name}});
  return list;
}

Json member_json(const Member& member, std::size_t index, Rate rate) {
  Json entry = {{"file", member.clip->file},
                {"tag", member.clip->tag},
                {"folder", "clips/" + folder_of(index, *member.clip)},
                {"frames", member.result.value("frames", 0)},
                {"samples", member.rows.size()},
                {"background", member.result.value("background", "")},
                {"scale", member.matching.scale},
                {"color", member.matching.gain}};
  entry["fps"] = {frames_a_second(member.rate), frames_a_second(rate)};
  if (member.clip->velocity) entry["velocity"] = *member.clip->velocity;
  if (member.clip->body) entry["body"] = *member.clip->body;
  if (!member.clip->events.empty()) {
    entry["range"] = {member.clip->first, member.clip->last};
    entry["events"] = events_json(*member.clip);
  }
  return entry;
}

Json cast_result(const StageRun& run, const std::vector<Member>& members, const CastRows& cast) {
  Json out = members.front().result;
  out.erase("dropped");
  out["film"] = fs::path(run.film).filename().string();
  out["samples"] = cast.rows.size();
  out["clips"] = cast.clips;
  for (const char* sum : {"frames", "duplicates", "cuts", "missing", "dropped_border",
                          "dropped_empty", "dropped_touched", "dropped_hidden", "dropped_short"}) {
    std::int64_t total = 0;
    for (const Member& member : members) total += member.result.value(sum, std::int64_t{0});
    out[sum] = total;
  }
  double noise = 0;
  for (const Member& member : members)
    noise = std::max(noise, member.matching.scale * member.result.value("velocity_noise", 0.0));
  out["velocity_noise"] = noise;
  // The pack lives on the first clip's floor.
  if (out.contains("floor")) out["floor"]["scale"] = cast.rows.front().scale;
  out["background"] = "each clip its own";
  out["cast"] = Json::array();
  out["warnings"] = Json::array();
  for (std::size_t k = 0; k < members.size(); ++k) {
    out["cast"].push_back(member_json(members[k], k, members.front().rate));
    for (const Json& warning : members[k].result.value("warnings", Json::array()))
      out["warnings"].push_back(members[k].clip->file + ": " + warning.get<std::string>());
    for (const std::string& warning : cast_warnings(members[k], cast))
      out["warnings"].push_back(members[k].clip->file + ": " + warning);
  }
  return out;
}

}  // namespace

Settings clip_settings(const Settings& settings, const CastClip& clip) {
  Settings own = settings;
  if (!clip.key.empty()) own.key = clip.key;
  if (!clip.subject.empty()) own.subject = clip.subject;
  own.matte = clip.matte;
  if (clip.fps > 0) own.fps = clip.fps;
  own.mirror = false;  // mirrored samples are made when all are numbered
  return own;
}

Result<StageKey> cast_key(StageRun& run) {
  const auto clips = read_cast(run.film);
  if (!clips) return clips.error();
  StageKey key{"segment", segment_settings(run.settings), Json::object()};
  if (!run.settings.matte.empty())
    return Error{
        ErrorCode::BadSetting,
        "--matte: the mattes of a cast stand with its clips: `matte = \"walk_matte.mp4\"`"};
  key.settings["cast"] = Json::array();
  for (const CastClip& clip : *clips) {
    Json entry = {{"file", clip.file}, {"frames", {clip.first, clip.last}}, {"tag", clip.tag},
                  {"key", clip.key},   {"subject", clip.subject},           {"match", clip.match}};
    if (clip.mirror) entry["mirror"] = *clip.mirror;
    if (clip.velocity) entry["velocity"] = *clip.velocity;
    if (clip.body) entry["body"] = *clip.body;
    if (!clip.matte.empty()) entry["matte"] = true;
    const Settings own = clip_settings(run.settings, clip);
    if (is_picture_source(clip.path)) entry["fps"] = own.fps;
    if (!clip.events.empty()) entry["events"] = events_json(clip);
    key.settings["cast"].push_back(std::move(entry));
    const auto sum = hash_source(source_of(own, clip.path));
    if (!sum) return sum.error();
    key.inputs[clip.file] = hex64(*sum);
  }
  return key;
}

Result<Json> segment_cast(StageRun& run) {
  const auto clips = read_cast(run.film);
  if (!clips) return clips.error();
  auto members = segment_members(run, *clips);
  if (!members) return members.error();
  const Member& first = members->front();
  for (Member& member : *members)
    if (member.clip->match && &member != &first)
      member.matching =
          match_clip(median_area(member.rows), member.color, median_area(first.rows), first.color);
  const CastRows cast = number_through(*members, run.settings);
  if (auto wrote = write_pictures(run, cast); !wrote) return wrote.error();
  if (auto wrote = write_file(run.project.path("samples.csv"), format_samples(cast.rows)); !wrote)
    return wrote.error();
  return cast_result(run, *members, cast);
}

std::string describe_matching(const Json& clip) {
  const auto number = [](double value, int decimals) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return std::string(text);
  };
  std::string changed;
  const auto add = [&changed](const std::string& text) {
    changed += (changed.empty() ? "" : ", ") + text;
  };
  if (const double scale = clip.value("scale", 1.0); scale != 1) add("scale x " + number(scale, 2));
  const Json gain = clip.value("color", Json::array());
  if (gain.size() == 3 && (gain[0] != 1 || gain[1] != 1 || gain[2] != 1)) {
    std::string text = "colour x";
    for (const Json& value : gain) text += " " + number(value.get<double>(), 2);
    add(text);
  }
  const Json fps = clip.value("fps", Json::array());
  if (fps.size() == 2 && fps[0] != fps[1])
    add(number_text(fps[0].get<double>()) + " to " + number_text(fps[1].get<double>()) +
        " frames a second");
  if (changed.empty()) return {};
  const std::string tag = clip.value("tag", ""), file = clip.value("file", "");
  return (tag.empty() ? file : tag + " (" + file + ")") + ": " + changed;
}

}  // namespace vsprite
