// `tidemark check --portable`: finds code that does not compile on ShaderToy's own site.
#pragma once

#include "cli/requests.hpp"
#include "platform/device_choice.hpp"

#include <string>

namespace tidemark::cli {

/// Prints one line for each place that the site's compiler refuses; returns exit code 1 if there is one.
Result<int> check_portable(const SceneRequest& request, const platform::DeviceChoice& device, bool as_json);

} // namespace tidemark::cli
