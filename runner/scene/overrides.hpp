// What the command line changes in a scene that is loaded: `--channel` and `--set`.
#pragma once

#include "base/result.hpp"
#include "scene/scene.hpp"

#include <string_view>
#include <utility>

namespace tidemark::scene {

/// Carries out `--channel [PASS:]N=WHAT`: a picture file, `noise`, `none`; sampled as ShaderToy's textures
/// are.
Result<void> override_channel(Scene& scene, std::string_view setting);

/// Carries out `--set NAME=VALUE`. A value outside of the knob's range is taken, with a warning.
Result<void> override_knob(Scene& scene, std::string_view setting);

/// NAME and VALUE of `NAME=VALUE`; the error names the option that wants this form.
Result<std::pair<std::string_view, std::string_view>> split_setting(std::string_view setting,
                                                                    std::string_view option);

} // namespace tidemark::scene
