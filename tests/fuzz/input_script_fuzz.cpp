// Recorded mouse and keyboard events (--input).
#include "fuzz.hpp"
#include "host/input_script.hpp"
#include "host/requests.hpp"

using namespace tidemark;

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const auto script = host::parse_input_script(text_of(data, size), "take.txt");
    if (!script) {
        REQUIRE(script.error().diagnostics.size() == 1 && script.error().diagnostics[0].where.line > 0);
        return 0;
    }
    const auto again = host::parse_input_script(host::to_string(*script), "again.txt");
    REQUIRE(again && *again == *script);
    host::Replay replay(*script, {});
    for (const int frame : {0, 7, 3, render::k_last_frame}) {
        render::FrameState state{.frame = frame, .extent = {100, 100}};
        replay.fill(state);
        REQUIRE(state == state); // no NaN
    }
    return 0;
}
