// Driver logs: any text gives messages, and places only where the text has lines. Any line is a count of
// instructions or none.
#include "fuzz.hpp"
#include "glsl/driver_log.hpp"
#include "glsl/instruction_count.hpp"

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
    if (const auto count = glsl::read_instruction_count(text_of(data, size)))
        REQUIRE(count->instructions >= 0 && !count->shader.empty());
    return 0;
}
