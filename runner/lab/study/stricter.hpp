// What comes after the strictest value of a knob, for references that go on until nothing changes. Pure.
#pragma once

#include "lab/study/study.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tidemark::lab {

/// A value that is a plain, finite number.
std::optional<double> number_of(const std::string& text);

/// GLSL takes `64` for an int and `64.0` for a float.
bool is_int(const std::string& number);

/// A number times a factor, of the kind it is; nothing where a whole number would leave 1 to 2^30.
std::optional<std::string> scaled(const std::string& text, double factor);

/// The axis continued by so many values: in the ratio of its last two, at least a factor of two. Nothing for
/// texts that are no numbers, a single value, and whole numbers that would come below 1. Below 0: so many
/// values back.
std::optional<std::string> beyond(const Axis& axis, int steps);

/// Every knob that a study turns, with its values from coarse to strict: the axes of its last series and
/// whatever that series fixes and others fix differently.
std::vector<Axis> axes_of(const Study& study);

/// The settings at which the study is most exact, `steps` further than it goes itself: its reference settings
/// where it names some, twice as strict at each step, else the end of each axis. Equal to those of `steps` -
/// 1 where nothing can go on. Below 0: so many steps coarser.
std::vector<Setting> strictest(const Study& study, int steps);

/// Settings off that ladder, where what repeats itself on it shows: each number that could go on is 1.37
/// times as strict, a whole one odd for even. `second`: a whole one is one more, so that no cycle of any
/// length hides, others are 1.71 times as strict.
std::vector<Setting> beside(const Study& study, int steps, bool second);

} // namespace tidemark::lab
