#include "text/mapped_text.hpp"

#include <algorithm>
#include <cassert>
#include <limits>

namespace tidemark::text {

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
    return {file, run.source_line + (line - run.line), column};
}

void LineMap::append(const LineMap& other, int first_line) {
    for (const Run& run : other.runs_)
        begin_run(run.line + first_line - 1, other.files_[size_t(run.file)], run.source_line);
}

void MappedText::append(std::string_view chunk, std::string_view file, int first_line) {
    if (chunk.empty())
        return;
    lines_.begin_run(line_count_ + 1, file, first_line);
    append_lines(chunk);
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
    size_t copied = 0;
    for (const Edit& edit : edits) {
        assert(edit.begin >= copied && edit.end >= edit.begin && edit.end <= text_.size());
        const std::string_view removed = std::string_view(text_).substr(edit.begin, edit.end - edit.begin);
        result.append(text_, copied, edit.begin - copied);
        result += edit.replacement;
        result.append(size_t(std::count(removed.begin(), removed.end(), '\n')), '\n');
        copied = edit.end;
    }
    result.append(text_, copied, std::string::npos);
    text_ = std::move(result);
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

} // namespace tidemark::text
