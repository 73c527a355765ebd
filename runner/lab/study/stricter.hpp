// What comes after the strictest value of a knob, for references that go on until nothing changes. Pure.
#pragma once

#include "lab/study/study.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tidemark::lab {

/// The axis continued by so many values: in the ratio of its last two, at least a factor of two. Nothing for
/// texts that are no numbers, a single value, and whole numbers that would come below 1.
std::optional<std::string> beyond(const Axis& axis, int steps);

/// Every knob that a study turns, with its values from coarse to strict: the axes of its last series and
/// whatever that series fixes and others fix differently.
std::vector<Axis> axes_of(const Study& study);

/// The settings at which the study is most exact, `steps` further than it goes itself: its reference settings
/// where it names some, twice as strict at each step, else the end of each axis. Equal to those of `steps` -
/// 1 where nothing can go on.
std::vector<Setting> strictest(const Study& study, int steps);

} // namespace tidemark::lab
