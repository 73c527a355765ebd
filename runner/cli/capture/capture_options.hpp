// The options of `tidemark capture`, for other code that parses its command line.
#pragma once

#include "cli/command_line.hpp"

#include <string>

namespace tidemark::cli {

struct CaptureOptions;

void add_capture_options(Command command, CaptureOptions& options);

/// Adds --codec, for every command that makes videos.
void add_codec_option(Command command, std::string& codec);

} // namespace tidemark::cli
