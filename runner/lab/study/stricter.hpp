// Continues the values of a knob beyond the strictest one, for references that are refined until nothing
// changes. Pure.
#pragma once

#include "lab/study/study.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tidemark::lab {

/// Returns the number if the whole text is a plain, finite number.
std::optional<double> number_of(const std::string& text);

/// Returns whether GLSL reads a number as an int: `64` is an int, `64.0` a float.
bool is_int(const std::string& number);

/// Multiplies a number, keeping its type; nullopt if a whole number would leave the range 1 to 2^30.
std::optional<std::string> scaled(const std::string& text, double factor);

/// Returns the value `steps` beyond the end of the axis: in the ratio of its last two values, at least a
/// factor of two. Returns nullopt for texts that are not numbers, a single value, and whole numbers that
/// would fall below 1. A negative `steps` goes back.
std::optional<std::string> beyond(const Axis& axis, int steps);

/// Returns every knob that a study varies, with its values from coarse to strict: the axes of its last
/// series, and the knobs that this series fixes and others fix differently.
std::vector<Axis> axes_of(const Study& study);

/// Returns the settings at which the study is most exact, `steps` steps beyond its own: its reference
/// settings if it has some, twice as strict at each step, else the end of each axis. They equal those of
/// `steps` - 1 if no value can continue. A negative `steps` is coarser.
std::vector<Setting> strictest(const Study& study, int steps);

/// Returns settings off that ladder, which reveal values that repeat on it: each number that can continue is
/// 1.37 times as strict, and a whole number changes between odd and even. With `second`, a whole number is
/// one step further, so no cycle of any length stays hidden, and other numbers are 1.71 times as strict.
std::vector<Setting> beside(const Study& study, int steps, bool second);

} // namespace tidemark::lab
