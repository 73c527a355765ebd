#include "lab/check/probe_text.hpp"

#include "base/try.hpp"
#include "lab/trace/watched_run.hpp"

#include <fmt/format.h>

namespace tidemark::lab {

Result<std::vector<PassText>> read_texts(ProbeBench& bench, bool as_written) {
    const auto renderer = TRY(bench.compiled());
    std::vector<PassText> texts;
    for (const render::PlannedPass& planned : (renderer)->plan().passes) {
        if (bench.scene().passes[planned.pass].kind == scene::PassKind::cubemap)
            continue;
        auto text = TRY(read_text(*renderer, planned.pass, as_written));
        glsl::TreeFacts facts = glsl::find_facts(*text);
        texts.push_back({planned.pass, std::move(text), std::move(facts)});
    }
    return texts;
}

std::string place_of(const glsl::ParsedText& text, size_t word) {
    const SourceLocation where = text.spelled(word);
    return where.file.empty() ? std::string() : fmt::format("{}:{}", where.file, where.line);
}

std::string listed(const std::vector<std::string>& names) {
    constexpr size_t k_most = 4;
    std::string text;
    for (size_t i = 0; i < names.size() && i < k_most; ++i)
        text += fmt::format("{}{}", i > 0 ? ", " : "", names[i]);
    if (names.size() > k_most)
        text += fmt::format(" and {} more", names.size() - k_most);
    return text;
}

} // namespace tidemark::lab
