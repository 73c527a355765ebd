// Promotion of any text: no line moves, every place that is reported exists, and what promotes gives the same
// text when it is promoted again from the same input. The first line says whether hashes are promoted too.
#include "fuzz.hpp"
#include "shader/promote.hpp"

#include <algorithm>
#include <string>

using namespace tidemark;

namespace {

long lines_of(const std::string& text) {
    return std::count(text.begin(), text.end(), '\n');
}

} // namespace

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    std::string_view rest = text_of(data, size);
    const bool hashes_too = cut(rest, '\n') == "hashes";
    text::MappedText body;
    body.append_generated(
        "layout(location = 0) out vec4 tidemark_color;\nvoid main() { tidemark_color = vec4(1.0); }\n");
    body.append(rest, "a.glsl", 1);
    const auto promoted = glsl::promote(body, hashes_too);
    if (!promoted) {
        REQUIRE(promoted.error().code == ErrorCode::load && promoted.error().diagnostics.size() == 1);
        const SourceLocation& where = promoted.error().diagnostics[0].where;
        REQUIRE(where.line >= 1 && where.line <= body.line_count());
        return 0;
    }
    REQUIRE(promoted->body.line_count() == body.line_count());
    REQUIRE(lines_of(promoted->body.text()) == lines_of(body.text()));
    for (const glsl::KeptHash& hash : promoted->hashes)
        REQUIRE(hash.where.file == "a.glsl" && hash.where.line >= 1 && hash.where.line <= body.line_count());
    REQUIRE(!hashes_too || std::all_of(promoted->hashes.begin(), promoted->hashes.end(),
                                       [](const auto& hash) { return hash.kind == glsl::HashKind::bits; }));
    const auto again = glsl::promote(body, hashes_too);
    REQUIRE(again && again->body.text() == promoted->body.text() && again->functions == promoted->functions);
    return 0;
}
