// The options of `tidemark capture`, for whoever reads its words.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace tidemark::cli {

struct CaptureOptions;

void add_capture_options(CLI::App& command, CaptureOptions& options);

/// --codec: of every command that makes videos.
void add_codec_option(CLI::App& command, std::string& codec);

} // namespace tidemark::cli
