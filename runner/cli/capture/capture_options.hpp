// The options of `tidemark capture`, for whoever reads its words.
#pragma once

#include "cli/command_line.hpp"

#include <string>

namespace tidemark::cli {

struct CaptureOptions;

void add_capture_options(Command command, CaptureOptions& options);

/// --codec: of every command that makes videos.
void add_codec_option(Command command, std::string& codec);

} // namespace tidemark::cli
