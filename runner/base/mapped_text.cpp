#include "base/mapped_text.hpp"

#include "base/file.hpp"
#include "base/tokens.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <optional>
#include <set>

namespace tidemark::text {
namespace {

bool stands_before(const LineMap::Shift& a, const LineMap::Shift& b) {
    return a.line != b.line ? a.line < b.line : a.column < b.column;
}

/// Computes line and column of increasing offsets.
class Cursor {
public:
    explicit Cursor(std::string_view text) : text_(text) {}

    void advance(size_t to) {
        for (; at_ < to; ++at_)
            if (text_[at_] == '\n') {
                ++line_;
                line_begin_ = at_ + 1;
            }
    }
    int line() const { return line_; }
    int column() const { return int(at_ - line_begin_) + 1; }

private:
    std::string_view text_;
    size_t at_ = 0;
    size_t line_begin_ = 0;
    int line_ = 1;
};

/// Returns the offset of each token of a replacement that does not begin at offset 0. The author wrote all of
/// them in one place.
std::vector<size_t> inner_words(std::string_view replacement) {
    std::vector<size_t> begins;
    for (size_t i = 1; i < replacement.size(); ++i)
        if (replacement[i] != ' ' &&
            !(is_word_character(replacement[i]) && is_word_character(replacement[i - 1])))
            begins.push_back(i);
    return begins;
}

constexpr std::string_view k_line_joint = "\\\n";

/// Returns whether two characters can belong to one token, or begin a comment.
bool may_be_of_one_token(char left, char right) {
    constexpr std::string_view signs = "+-*/%<>=!&|^#.";
    return (is_word_character(left) || left == '.')
               ? is_word_character(right) || right == '.'
               : signs.find(left) != signs.npos && signs.find(right) != signs.npos;
}

/// Returns edits that put joined lines, from offset `begin` on, into one where a joint splits a token.
std::vector<Edit> joined_lines(std::string_view text, size_t begin) {
    std::vector<Edit> edits;
    size_t joint = text.find(k_line_joint, begin);
    while (joint != text.npos) {
        size_t after = joint;
        while (text.substr(after).starts_with(k_line_joint))
            after += k_line_joint.size();
        if (joint == begin || after == text.size() || !may_be_of_one_token(text[joint - 1], text[after])) {
            joint = text.find(k_line_joint, after);
            continue;
        }
        Edit edit{joint, after};
        while (after < text.size() && text[after] != '\n') {
            const bool joins = text.substr(after).starts_with(k_line_joint);
            if (!joins)
                edit.replacement += text[after];
            after += joins ? k_line_joint.size() : 1;
        }
        edit.end = after;
        edits.push_back(std::move(edit));
        joint = text.find(k_line_joint, after);
    }
    return edits;
}

} // namespace

void LineMap::begin_run(int line, std::string_view file, int source_line) {
    auto known = std::find(files_.begin(), files_.end(), file);
    if (known == files_.end())
        known = files_.emplace(files_.end(), file);
    runs_.push_back({line, int(known - files_.begin()), source_line});
}

SourceLocation LineMap::locate(int line, int column) const {
    auto next = std::upper_bound(runs_.begin(), runs_.end(), line,
                                 [](int wanted, const Run& run) { return wanted < run.line; });
    if (next == runs_.begin())
        return {};
    const Run& run = *std::prev(next);
    const std::string& file = files_[size_t(run.file)];
    const bool countable = line - run.line <= std::numeric_limits<int>::max() - run.source_line;
    if (file.empty() || !countable)
        return {};
    return {file, run.source_line + (line - run.line),
            column > 0 ? std::max(1, column + shift_at(line, column)) : column};
}

int LineMap::shift_at(int line, int column) const {
    const auto next = std::upper_bound(shifts_.begin(), shifts_.end(), Shift{line, column, 0}, stands_before);
    return next == shifts_.begin() || std::prev(next)->line != line ? 0 : std::prev(next)->by;
}

/// The existing shifts use columns before this call: their columns move, and both shifts are added up.
void LineMap::shift(const std::vector<Shift>& shifts) {
    std::vector<Shift> result;
    size_t old = 0;
    int before = 0; // sum of the old shifts at this column
    int added = 0;  // sum of the new shifts at this column
    int line = 0;
    const auto begin_line = [&](int next) {
        if (next != line)
            before = added = 0;
        line = next;
    };
    const auto take_old = [&](const Shift& shift) {
        begin_line(shift.line);
        before = shift.by;
        result.push_back({line, std::max(1, shift.column - added), before + added});
    };
    for (const Shift& shift : shifts) {
        const int total = shift.line == line ? added + shift.by : shift.by;
        // In the columns before this call, the new shift is at its own column plus all new shifts up to it.
        while (old < shifts_.size() && stands_before(shifts_[old], {shift.line, shift.column + total, 0}))
            take_old(shifts_[old++]);
        begin_line(shift.line);
        added = total;
        result.push_back({line, shift.column, before + added});
    }
    while (old < shifts_.size())
        take_old(shifts_[old++]);
    shifts_ = std::move(result);
}

void LineMap::append(const LineMap& other, int first_line) {
    for (const Run& run : other.runs_)
        begin_run(run.line + first_line - 1, other.files_[size_t(run.file)], run.source_line);
    for (const Shift& shift : other.shifts_)
        shifts_.push_back({shift.line + first_line - 1, shift.column, shift.by});
}

void MappedText::append(std::string_view chunk, std::string_view file, int first_line) {
    if (chunk.empty())
        return;
    lines_.begin_run(line_count_ + 1, file, first_line);
    const size_t begin = text_.size();
    append_lines(chunk);
    apply(joined_lines(text_, begin));
}

void MappedText::append(const MappedText& other) {
    lines_.append(other.lines_, line_count_ + 1);
    append_lines(other.text_);
}

void MappedText::append_lines(std::string_view chunk) {
    text_ += chunk;
    line_count_ += int(std::count(chunk.begin(), chunk.end(), '\n'));
    if (!chunk.empty() && chunk.back() != '\n') {
        text_ += '\n';
        ++line_count_;
    }
}

void MappedText::apply(const std::vector<Edit>& edits) {
    if (edits.empty())
        return;
    std::string result;
    result.reserve(text_.size());
    std::vector<LineMap::Shift> shifts;
    Cursor cursor(text_);
    size_t line_begin = 0; // in the result
    int line = 1;
    int told = 0; // sum of the shifts of this line so far
    size_t copied = 0;
    for (const Edit& edit : edits) {
        assert(edit.begin >= copied && edit.end >= edit.begin && edit.end <= text_.size());
        const std::string_view removed = std::string_view(text_).substr(edit.begin, edit.end - edit.begin);
        result.append(text_, copied, edit.begin - copied);
        cursor.advance(edit.begin);
        if (cursor.line() != line) {
            line = cursor.line();
            line_begin = result.rfind('\n') + 1;
            told = 0;
        }
        for (const size_t word : inner_words(edit.replacement)) {
            const int column = int(result.size() + word - line_begin) + 1;
            const int by = cursor.column() - column - told;
            shifts.push_back({line, column, by});
            told += by;
        }
        result += edit.replacement;
        result.append(size_t(std::count(removed.begin(), removed.end(), '\n')), '\n');
        copied = edit.end;
        cursor.advance(edit.end);
        if (cursor.line() != line) {
            line = cursor.line();
            line_begin = result.rfind('\n') + 1;
            told = 0;
        }
        const int column = int(result.size() - line_begin) + 1;
        const int by = cursor.column() - column - told;
        if (by != 0)
            shifts.push_back({line, column, by});
        told += by;
    }
    result.append(text_, copied, std::string::npos);
    text_ = std::move(result);
    lines_.shift(shifts);
}

std::string with_plain_line_ends(std::string text) {
    if (text.starts_with("\xEF\xBB\xBF"))
        text.erase(0, 3);
    size_t kept = 0;
    for (size_t i = 0; i < text.size(); ++i) {
        const bool before_line_feed = i + 1 < text.size() && text[i + 1] == '\n';
        if (text[i] == '\r' && before_line_feed)
            continue;
        text[kept++] = text[i] == '\r' ? '\n' : text[i];
    }
    text.resize(kept);
    return text;
}

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
    include.of_library = name.starts_with(k_library);
    include.in_angles = !include.of_library;
    include.name = include.of_library ? name.substr(k_library.size()) : name;
    include.end = last->end();
    return include;
}

bool has_pragma_once(std::string_view text) {
    if (text.find("once") == std::string_view::npos)
        return false;
    const std::vector<Token> tokens = tokenize(text);
    for (size_t i = 0; i + 2 < tokens.size(); ++i)
        if (tokens[i].first_on_line && tokens[i].is("#") && tokens[i + 1].is("pragma") &&
            tokens[i + 2].is("once"))
            return true;
    return false;
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
        if (has_pragma_once(text))
            once_.insert(path);
        size_t copied = 0;
        int line = 1;
        for (const Include& include : find_includes(text)) {
            result_.text.append(std::string_view(text).substr(copied, include.begin - copied), path.string(),
                                line);
            chain_.back().line = include.line;
            TRY(follow(path, include, text));
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

    /// Keeps the line: it may be meant for another host, and the driver decides whether it counts.
    void leave(const fs::path& from, const Include& include, const std::string& text) {
        const std::string_view line =
            std::string_view(text).substr(include.begin, include.end - include.begin);
        result_.text.append(line, from.string(), include.line);
    }

    Result<void> follow(const fs::path& from, const Include& include, const std::string& text) {
        if (include.in_angles && !include.conditional)
            return refuse(fmt::format("write the file's name in quotes: #include \"{}\"", include.name));
        if (include.in_angles) {
            leave(from, include, text);
            return {};
        }
        const fs::path folder = include.of_library ? library_ : from.parent_path();
        const fs::path target = (folder / include.name).lexically_normal();
        if (once_.contains(target))
            return {};
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
        if (include.conditional) {
            leave(from, include, text);
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
    std::set<fs::path> once_; ///< files with `#pragma once`
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
