// A camera setting over the frames of a shot: one value, or keys to interpolate between.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pullfocus {

// How focus distances between two keys come about.
enum class FocusInterp {
  dioptre,   // linear in 1/distance: CoC diameters change evenly
  distance,  // linear in distance; no key may be infinite
  smooth     // smoothstep 3t^2 - 2t^3 in 1/distance: starts and ends at rest
};

std::string_view name(FocusInterp interpolation) noexcept;  // as --focus-interp spells it
// Throws Error(usage) that begins with `where`.
FocusInterp parse_focus_interp(std::string_view text, std::string_view where = "--focus-interp");

enum class Infinity { refused, legal };

struct Key {
  int frame = 0;
  double value = 0;
  bool operator==(const Key&) const = default;
};

// Values are > 0; infinite ones only where the setting has a meaning for them. Held before the first and
// after the last key. At a key's frame the result is the key's value bit for bit, and between two equal keys
// it is constant. Constructors and parse() throw Error(usage) that begins with `where`: the option, or the
// place in a file.
class KeyedValue {
 public:
  KeyedValue(double value, std::string_view where, Infinity infinity);
  // Keys in any order, at least one, no frame twice.
  KeyedValue(std::vector<Key> keys, std::string_view where, Infinity infinity);

  // "VALUE" or "FRAME:VALUE,FRAME:VALUE,..."; blanks around numbers are ignored.
  static KeyedValue parse(std::string_view text, std::string_view where, Infinity infinity);
  std::string to_string() const;  // what parse() turns into an equal object

  bool is_constant() const noexcept { return constant_; }          // given as a plain value
  const std::vector<Key>& keys() const noexcept { return keys_; }  // by frame; of a constant, one at frame 0

  // Linear in the value: for f-numbers and focal lengths.
  double linear_at(int frame) const;
  // Throws Error(usage) naming --focus-interp if keys are infinite and the interpolation cannot take that.
  double focus_at(int frame, FocusInterp interpolation) const;

  bool operator==(const KeyedValue&) const = default;

 private:
  std::vector<Key> keys_;  // sorted by frame, never empty
  bool constant_ = false;
};

}  // namespace pullfocus
