// Changes a loaded scene as the options `--channel` and `--set` say.
#pragma once

#include "base/result.hpp"
#include "scene/scene.hpp"

#include <string_view>
#include <utility>

namespace tidemark::scene {

/// Applies `--channel [PASS:]N=WHAT`, where WHAT is a picture file, `noise`, `none` or another input; sampled
/// like ShaderToy's textures.
Result<void> override_channel(Scene& scene, std::string_view setting);

/// Applies `--set NAME=VALUE`. Accepts a value outside the knob's range, with a warning.
Result<void> override_knob(Scene& scene, std::string_view setting);

/// Splits `NAME=VALUE`; the error names the option that needs this form.
Result<std::pair<std::string_view, std::string_view>> split_setting(std::string_view setting,
                                                                    std::string_view option);

} // namespace tidemark::scene
