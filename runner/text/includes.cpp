#include "text/includes.hpp"

#include "base/file.hpp"
#include "text/tokens.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace tidemark::text {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view k_library = "tidemark/";

/// Returns the `#include` whose `#` is tokens[at]; nothing if it is left for the driver.
std::optional<Include> include_at(std::string_view text, const std::vector<Token>& tokens, size_t at) {
    const size_t end = end_of_directive(tokens, at);
    if (at + 2 >= end)
        return std::nullopt;
    const Token& first = tokens[at + 2];
    Include include{.begin = tokens[at].begin, .end = first.end(), .line = tokens[at].line};
    if (first.kind == TokenKind::string) {
        include.name = first.text.substr(1, first.text.size() - 2);
        return include;
    }
    const auto last = std::find_if(tokens.begin() + at + 2, tokens.begin() + end,
                                   [](const Token& token) { return token.is(">"); });
    if (!first.is("<") || last == tokens.begin() + end)
        return std::nullopt;
    const std::string_view name = text.substr(first.end(), last->begin - first.end());
    if (!name.starts_with(k_library))
        return std::nullopt;
    include.name = name.substr(k_library.size());
    include.of_library = true;
    include.end = last->end();
    return include;
}

/// Files that include others twice double the text at each level: a few small files could run for ever.
constexpr size_t k_most = 10'000;
constexpr size_t k_deepest = 100;

class Expander {
public:
    Expander(const ReadText& read, const fs::path& library) : read_(read), library_(library) {}

    Result<void> expand(const fs::path& path) {
        auto bytes = read_(path);
        if (!bytes) {
            missing_.push_back(path);
            return fail(std::move(bytes.error()));
        }
        if (std::find(result_.files.begin(), result_.files.end(), path) == result_.files.end())
            result_.files.push_back(path);
        return paste(path, with_plain_line_ends(*std::move(bytes)));
    }

    ExpandedText take() {
        result_.missing = std::move(missing_);
        return std::move(result_);
    }

    /// Adds every file that the error may be about.
    Error with_files(Error error) const {
        for (const auto* paths : {&result_.files, &missing_})
            for (const fs::path& path : *paths)
                error.files.push_back(path.string());
        return error;
    }

private:
    struct Level {
        fs::path file;
        int line = 0; ///< line of the #include that is being expanded
    };

    Result<void> paste(const fs::path& path, const std::string& text) {
        chain_.push_back({path});
        size_t copied = 0;
        int line = 1;
        for (const Include& include : find_includes(text)) {
            result_.text.append(std::string_view(text).substr(copied, include.begin - copied), path.string(),
                                line);
            chain_.back().line = include.line;
            if (auto followed = follow(path, include, text); !followed)
                return followed;
            copied = include.end;
            line = include.line;
        }
        result_.text.append(std::string_view(text).substr(copied), path.string(), line);
        chain_.back().line = 0;
        if (result_.text.text().size() > k_largest_text)
            return refuse(fmt::format("the includes add up to more than {} MiB", k_largest_text >> 20));
        chain_.pop_back();
        return {};
    }

    Result<void> follow(const fs::path& from, const Include& include, const std::string& text) {
        const fs::path folder = include.of_library ? library_ : from.parent_path();
        const fs::path target = (folder / include.name).lexically_normal();
        for (const Level& level : chain_)
            if (level.file == target)
                return refuse(fmt::format("'{}' includes itself", include.name));
        if (chain_.size() > k_deepest)
            return refuse(fmt::format("includes are nested more than {} deep", k_deepest));
        if (++followed_ > k_most)
            return refuse(fmt::format("there are more than {} includes to follow", k_most));
        auto pasted =
            include.name.empty() ? fail(ErrorCode::load, "#include \"\" names no file") : expand(target);
        if (pasted || !pasted.error().diagnostics.empty())
            return pasted;
        if (include.conditional) { // may be meant for another host; the driver decides whether it counts
            const std::string_view line =
                std::string_view(text).substr(include.begin, include.end - include.begin);
            result_.text.append(line, from.string(), include.line);
            return {};
        }
        return refuse(pasted.error().message);
    }

    /// Returns an error at the innermost #include, with one note for each file on the way to it.
    tl::unexpected<Error> refuse(std::string message) const {
        Error error = error_at({chain_.back().file.string(), chain_.back().line, 0}, std::move(message));
        for (size_t i = chain_.size() - 1; i-- > 0;)
            error.diagnostics.push_back(
                {{chain_[i].file.string(), chain_[i].line, 0}, Severity::note, "included from here"});
        return fail(std::move(error));
    }

    const ReadText& read_;
    const fs::path& library_;
    ExpandedText result_;
    std::vector<fs::path> missing_;
    size_t followed_ = 0;
    std::vector<Level> chain_;
};

} // namespace

std::vector<Include> find_includes(std::string_view text) {
    std::vector<Include> found;
    const std::vector<Token> tokens = tokenize(text);
    int depth = 0;
    for (size_t i = 0; i + 1 < tokens.size(); ++i) {
        if (!tokens[i].first_on_line || !tokens[i].is("#"))
            continue;
        const Token& keyword = tokens[i + 1];
        if (keyword.text.starts_with("if"))
            ++depth;
        else if (keyword.is("endif"))
            depth = std::max(0, depth - 1);
        else if (keyword.is("include"))
            if (auto include = include_at(text, tokens, i)) {
                include->conditional = depth > 0;
                found.push_back(*std::move(include));
            }
    }
    return found;
}

Result<ExpandedText> expand_includes(const fs::path& path, const ReadText& read, const fs::path& library) {
    Expander expander(read, library);
    if (auto done = expander.expand(path.lexically_normal()); !done)
        return fail(expander.with_files(std::move(done.error())));
    return expander.take();
}

} // namespace tidemark::text
