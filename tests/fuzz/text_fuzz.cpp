// Tokens, line ends and includes. A text is cut at form feeds into the files `a`, `b`, `c` …, of which the
// first is expanded.
#include "base/mapped_text.hpp"
#include "base/tokens.hpp"
#include "fuzz.hpp"

#include <algorithm>
#include <map>
#include <string>

using namespace tidemark;

namespace {

void check_tokens(std::string_view text) {
    size_t end = 0;
    int line = 1;
    size_t line_begin = 0;
    for (const text::Token& token : text::tokenize(text)) {
        REQUIRE(!token.text.empty());
        REQUIRE(token.begin >= end && token.end() <= text.size());
        REQUIRE(token.text == text.substr(token.begin, token.text.size()));
        REQUIRE(token.text.find('\n') == token.text.npos);
        for (size_t i = end; i < token.begin; ++i)
            if (text[i] == '\n') {
                ++line;
                line_begin = i + 1;
            }
        REQUIRE(token.line == line);
        REQUIRE(token.column == int(token.begin - line_begin) + 1);
        REQUIRE(!token.glued || token.begin == end);
        end = token.end();
    }
}

} // namespace

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    std::string_view text = text_of(data, size);
    check_tokens(text);
    const std::string plain = text::with_plain_line_ends(std::string(text));
    REQUIRE(plain.find('\r') == plain.npos);

    std::map<std::string, std::string> files;
    for (char name = 'a'; name <= 'z' && !text.empty(); ++name)
        files[std::string(1, name)] = cut(text, '\f');
    const auto read = [&](const std::filesystem::path& path) -> Result<std::string> {
        const auto found = files.find(path.string());
        if (found == files.end())
            return fail(ErrorCode::load, "no such file");
        return found->second;
    };
    const auto expanded = text::expand_includes("a", read, "");
    if (!expanded) {
        REQUIRE(!to_string(expanded.error()).empty());
        return 0;
    }
    const std::string& whole = expanded->text.text();
    REQUIRE(expanded->text.line_count() == std::count(whole.begin(), whole.end(), '\n'));
    REQUIRE(whole.empty() || whole.back() == '\n');
    REQUIRE(expanded->files.size() <= files.size() && expanded->files.front() == "a");
    for (int line = 1; line <= expanded->text.line_count(); ++line) {
        const SourceLocation where = expanded->text.lines().locate(line);
        REQUIRE(files.count(where.file) == 1 && where.line >= 1);
    }
    return 0;
}
