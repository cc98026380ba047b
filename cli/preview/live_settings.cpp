// Of a session: the camera's settings and their keys.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "image/error.h"
#include "integers.h"
#include "preview/live_session.h"
#include "preview/pick.h"

namespace pullfocus::cli::preview {

namespace {

Infinity infinity_of(const std::string& name) { return name == "focus" ? Infinity::legal : Infinity::refused; }

}  // namespace

std::optional<KeyedValue>& LiveSession::setting(CameraKeys& keys, const std::string& name) const {
  if (camera_.depth_kind() == DepthKind::coc) {
    throw Error(ErrorCode::usage, name + ": the depth is a CoC diameter (--depth-kind coc): there is no lens to set");
  }
  if (name == "focus") return keys.focus;
  if (name == "fstop") return keys.fstop;
  if (name == "focal-length") return keys.focal_length;
  throw Error(ErrorCode::usage, "'" + name + "' is no setting: use focus, fstop or focal-length");
}

const exr::FileInfo& LiveSession::file_now() const {
  const FrameCache::Entry entry = open_->cache.look(frame_);
  return entry.frame ? entry.frame->file : open_->shot.sequence().first;
}

SettingNow LiveSession::setting_now(const std::string& name) const {
  const CameraKeys& keys = choice_.keys;
  const std::optional<KeyedValue>& given = name == "focus"   ? keys.focus
                                           : name == "fstop" ? keys.fstop
                                                             : keys.focal_length;
  try {
    if (given) {
      return {name == "focus" ? given->focus_at(number(), keys.interpolation) : given->linear_at(number()),
              given->is_constant() ? "set" : "keys"};
    }
  } catch (const Error&) {  // interpolation between infinite keys, which the engine reports
    return {};
  }
  const exr::CameraAttributes& header = file_now().camera;
  const std::optional<float> value = name == "focus"   ? header.focus_distance_m
                                     : name == "fstop" ? header.fstop
                                                       : header.focal_length_mm;
  if (!value) return {};
  return {static_cast<double>(*value) / (name == "focus" ? arguments_.camera.unit : 1), "header"};
}

// A setting with keys gets one at the current frame; one without becomes constant.
void LiveSession::set(const std::string& name, const std::string& text) {
  Choice choice = choice_;
  std::optional<KeyedValue>& target = setting(choice.keys, name);
  const KeyedValue typed = KeyedValue::parse(text, name, infinity_of(name));
  if (!target || target->is_constant() || !typed.is_constant()) {
    target = typed;
  } else {
    std::vector<Key> keys = target->keys();
    std::erase_if(keys, [&](const Key& key) { return key.frame == number(); });
    keys.push_back({number(), typed.linear_at(0)});
    target = KeyedValue(std::move(keys), name, infinity_of(name));
  }
  choose(std::move(choice));
}

void LiveSession::focus_at(const Words& words) {
  int x = 0, y = 0;
  if (!read_integers(words[0], ",", {&x, &y})) {
    throw Error(ErrorCode::usage, "focus-at '" + words[0] + "' is not X,Y in pixels, such as 960,540");
  }
  CameraKeys keys = choice_.keys;
  setting(keys, "focus");
  const Window& w = open_->shot.state_window();
  if (!w.contains(x, y)) {
    throw Error(ErrorCode::usage, fmt::format("focus-at {},{} lies outside the picture: x is {} to {}, y {} to {}", x,
                                              y, w.x0, w.x1 - 1, w.y0, w.y1 - 1));
  }
  const FrameCache::Entry entry = open_->cache.look(frame_);
  if (!entry.frame) throw Error(ErrorCode::content, fmt::format("focus-at: frame {} is not read yet", number()));
  set("focus", fmt::format("{}", focus_distance_at(entry.frame->frame, camera_.depth_kind(), x, y)));
}

// key SETTING [FRAME [VALUE]]
void LiveSession::set_key(const Words& words) {
  const std::string& name = words[0];
  Choice choice = choice_;
  std::optional<KeyedValue>& target = setting(choice.keys, name);
  int frame = number();
  if (words.size() > 1 && !read_integers(words[1], "", {&frame})) {
    throw Error(ErrorCode::usage, "key: '" + words[1] + "' is not a frame number");
  }
  double value = 0;
  if (words.size() > 2) {
    const KeyedValue typed = KeyedValue::parse(words[2], name, infinity_of(name));
    if (!typed.is_constant()) throw Error(ErrorCode::usage, "key: '" + words[2] + "' is not one value");
    value = typed.linear_at(0);
  } else {
    const std::optional<double> now = setting_now(name).value;
    if (!now) throw Error(ErrorCode::usage, "key: " + name + " has no value yet: set it first");
    value = *now;
  }
  std::vector<Key> keys = target && !target->is_constant() ? target->keys() : std::vector<Key>{};
  std::erase_if(keys, [&](const Key& key) { return key.frame == frame; });
  keys.push_back({frame, value});
  target = KeyedValue(std::move(keys), name, infinity_of(name));
  choose(std::move(choice));
}

// unkey SETTING [FRAME | all]; without its last key a setting keeps that one's value.
void LiveSession::remove_key(const Words& words) {
  const std::string& name = words[0];
  Choice choice = choice_;
  std::optional<KeyedValue>& target = setting(choice.keys, name);
  if (!target || target->is_constant()) throw Error(ErrorCode::usage, "unkey: " + name + " has no keys");
  const bool all = words.size() > 1 && words[1] == "all";
  int frame = number();
  if (words.size() > 1 && !all && !read_integers(words[1], "", {&frame})) {
    throw Error(ErrorCode::usage, "unkey: '" + words[1] + "' is neither a frame number nor 'all'");
  }
  std::vector<Key> keys = target->keys();
  const double value = setting_now(name).value.value_or(keys.front().value);
  if (!all && std::erase_if(keys, [&](const Key& key) { return key.frame == frame; }) == 0) {
    throw Error(ErrorCode::usage, fmt::format("unkey: {} has no key at frame {}", name, frame));
  }
  if (all || keys.empty()) {
    target = KeyedValue(value, name, infinity_of(name));
  } else {
    target = KeyedValue(std::move(keys), name, infinity_of(name));
  }
  choose(std::move(choice));
}

// move-key SETTING FROM TO; a key that is at TO already gives way.
void LiveSession::move_key(const Words& words) {
  const std::string& name = words[0];
  Choice choice = choice_;
  std::optional<KeyedValue>& target = setting(choice.keys, name);
  int from = 0, to = 0;
  if (!read_integers(words[1], "", {&from}) || !read_integers(words[2], "", {&to})) {
    throw Error(ErrorCode::usage, "move-key: give two frame numbers, from where to where");
  }
  if (target && target->is_constant()) target.reset();
  std::vector<Key> keys = target ? target->keys() : std::vector<Key>{};
  const auto key = std::find_if(keys.begin(), keys.end(), [&](const Key& k) { return k.frame == from; });
  if (key == keys.end()) throw Error(ErrorCode::usage, fmt::format("move-key: {} has no key at frame {}", name, from));
  const double value = key->value;
  std::erase_if(keys, [&](const Key& k) { return k.frame == from || k.frame == to; });
  keys.push_back({to, value});
  target = KeyedValue(std::move(keys), name, infinity_of(name));
  choose(std::move(choice));
}

}  // namespace pullfocus::cli::preview
