// The options of `tidemark capture`, for whoever reads its words.
#pragma once

namespace CLI {
class App;
}

namespace tidemark::cli {

struct CaptureOptions;

void add_capture_options(CLI::App& command, CaptureOptions& options);

} // namespace tidemark::cli
