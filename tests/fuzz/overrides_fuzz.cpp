// `--define` and assembly in every dialect: the first line is the setting, the rest the scene. No line moves,
// and every line of the author's is found again.
#include "fuzz.hpp"
#include "shader/definitions.hpp"
#include "shader/pass_reading.hpp"

#include <string>

using namespace tidemark;

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    std::string_view rest = text_of(data, size);
    const std::string_view setting = cut(rest, '\n');
    scene::Scene scene;
    scene.passes.resize(1);
    text::MappedText& text = scene.passes[0].text;
    text.append(rest, "a.glsl", 1);
    const std::string before = text.text();
    const auto lines = [](const std::string& of) { return std::count(of.begin(), of.end(), '\n'); };
    const auto done = glsl::override_definition(scene, setting);
    REQUIRE(done || text.text() == before);
    REQUIRE(done || (done.error().code == ErrorCode::usage && !done.error().message.empty()));
    REQUIRE(lines(text.text()) == lines(before));

    const glsl::PassReading reading(scene, scene.image());
    for (const glsl::Dialect& dialect : reading.dialects(glsl::Precision::single)) {
        const text::MappedText source = reading.assemble(dialect)->source;
        REQUIRE(source.line_count() == lines(source.text()));
        int next = 1;
        for (int line = 1; line <= source.line_count(); ++line) {
            const SourceLocation where = source.lines().locate(line);
            REQUIRE(where.file.empty() || where.line == next++);
        }
        REQUIRE(next == text.line_count() + 1);
    }
    return 0;
}
