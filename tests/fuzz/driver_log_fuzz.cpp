// Driver logs: any text gives messages, and places only where the text has lines.
#include "fuzz.hpp"
#include "glsl/driver_log.hpp"

using namespace tidemark;

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    text::LineMap lines;
    lines.begin_run(1, "", 0);
    lines.begin_run(5, "a.glsl", 3);
    lines.begin_run(9, "b.glsl", 1);
    for (const Diagnostic& diagnostic : glsl::parse_driver_log(text_of(data, size), lines)) {
        REQUIRE(diagnostic.message.find('\n') == diagnostic.message.npos);
        REQUIRE(diagnostic.where.file.empty() ? diagnostic.where.line == 0 : diagnostic.where.line >= 1);
        REQUIRE(!to_string(diagnostic).empty());
    }
    return 0;
}
