// Driver logs: any log about any text gives messages, and places only where that text has lines. Any line is
// a count of instructions or none.
#include "fuzz.hpp"
#include "shader/driver_log.hpp"

using namespace tidemark;

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string_view both = text_of(data, size);
    const size_t half = std::min(both.find('\1'), both.size()); // the log, then what it is about
    text::MappedText source;
    source.append_generated("#define F(x) \\\n x\n#define OBJECT\n\n");
    source.append(both.substr(half), "a.glsl", 3);
    const auto messages = glsl::parse_driver_log(both.substr(0, half), source);
    for (const auto& [diagnostic, follows] : messages) {
        REQUIRE(diagnostic.message.find('\n') == diagnostic.message.npos);
        REQUIRE(diagnostic.where.file.empty() ? diagnostic.where.line == 0 : diagnostic.where.line >= 1);
        REQUIRE(!to_string(diagnostic).empty());
    }
    REQUIRE(messages.empty() == glsl::for_people(messages).empty());
    if (const auto count = glsl::read_instruction_count(text_of(data, size)))
        REQUIRE(count->instructions >= 0 && !count->shader.empty());
    return 0;
}
