#include "glsl/cure/cure.hpp"

#include "text/lines.hpp"

#include <algorithm>
#include <map>

namespace tidemark::glsl {
namespace {

/// A wrap at one of the places where its tokens are.
struct Placed {
    size_t begin = 0, end = 0;
    const Wrap* wrap = nullptr;
    size_t cure = 0;

    bool encloses(const Placed& other) const {
        const bool same = begin == other.begin && end == other.end;
        return begin <= other.begin && other.end <= end && (!same || cure > other.cure);
    }
    bool overlaps(const Placed& other) const { return begin < other.end && other.begin < end; }
};

/// One insertion. Insertions at one place are ordered: end of an inner wrap, end of an outer one, start of an
/// outer one, start of an inner one. Of two wraps around the same tokens, the later cure is the outer one.
struct Insertion {
    size_t at = 0;
    bool front = false;
    size_t other = 0; ///< position of the other half of its wrap
    std::string_view text{};
    size_t cure = 0;
    size_t until = 0; ///< the text up to here is removed

    bool stands_before(const Insertion& next) const {
        if (at != next.at)
            return at < next.at;
        if (front != next.front)
            return next.front;
        return other != next.other ? other > next.other : front ? cure > next.cure : cure < next.cure;
    }
};

std::vector<text::Edit> edits_of(const std::vector<Placed>& wraps) {
    std::vector<Insertion> insertions;
    for (const Placed& each : wraps) {
        const size_t until = each.wrap->replaces ? each.end : each.begin;
        insertions.push_back({each.begin, true, each.end, each.wrap->front, each.cure, until});
        insertions.push_back({each.end, false, each.begin, each.wrap->behind, each.cure, each.end});
    }
    std::ranges::stable_sort(insertions, [](const auto& a, const auto& b) { return a.stands_before(b); });
    std::vector<text::Edit> edits;
    for (const Insertion& each : insertions)
        edits.push_back({each.at, each.until, std::string(each.text)});
    return edits;
}

/// Removes wraps whose text another wrap replaces. Returns false if two overlap and neither is inside the
/// other.
bool leave_out_replaced(std::vector<Placed>& wraps) {
    const std::vector<Placed> all = wraps;
    std::erase_if(wraps, [&](const Placed& each) {
        return std::ranges::any_of(all, [&](const Placed& other) {
            return other.wrap->replaces && other.wrap != each.wrap && other.encloses(each);
        });
    });
    return std::ranges::none_of(wraps, [&](const Placed& each) {
        return each.wrap->replaces && std::ranges::any_of(wraps, [&](const Placed& other) {
                   return other.wrap != each.wrap && each.overlaps(other) && !other.encloses(each);
               });
    });
}

/// Finds the lines of a text by their file and line number in the author's files.
class Lines {
public:
    explicit Lines(const text::MappedText& text) : text_(text) {
        int number = 0;
        for (const std::string_view line : text::lines_of(text.text())) {
            const SourceLocation where = text.lines().locate(++number);
            lines_[{where.file, where.line}].push_back({number, line});
        }
    }

    /// Returns every offset of the token. A file may be in the text more than once.
    std::vector<size_t> find(const WrittenWord& wanted) const {
        std::vector<size_t> found;
        const auto lines = lines_.find({wanted.where.file, wanted.where.line});
        if (lines == lines_.end())
            return found;
        for (const Line& line : lines->second)
            for (size_t i = line.text.find(wanted.word); i != line.text.npos;
                 i = line.text.find(wanted.word, i + 1))
                if (text_.lines().locate(line.number, int(i) + 1).column == wanted.where.column) {
                    found.push_back(size_t(line.text.data() - text_.text().data()) + i);
                    break;
                }
        return found;
    }

private:
    struct Line {
        int number;
        std::string_view text;
    };
    const text::MappedText& text_;
    std::map<std::pair<std::string, int>, std::vector<Line>> lines_;
};

/// Returns nothing if a wrap's first and last tokens do not occur equally often.
std::optional<std::vector<Placed>> placed(const Lines& lines, std::span<const Cure> cures) {
    std::vector<Placed> all;
    for (size_t number = 0; number < cures.size(); ++number)
        for (const Wrap& wrap : cures[number].wraps) {
            const auto begins = lines.find(wrap.first), ends = lines.find(wrap.last);
            if (begins.size() != ends.size())
                return std::nullopt;
            for (size_t i = 0; i < begins.size(); ++i)
                all.push_back({begins[i], ends[i] + wrap.last.word.size(), &wrap, number});
        }
    return all;
}

/// Returns the text with LF for every CR that ends a line alone; other line ends stay.
std::string with_line_feeds(std::string_view text) {
    std::string result(text);
    for (size_t i = 0; i < result.size(); ++i)
        if (result[i] == '\r' && (i + 1 == result.size() || result[i + 1] != '\n'))
            result[i] = '\n';
    return result;
}

/// Restores the original's line ends; both texts have the same number of lines.
void restore_line_ends(std::string& text, std::string_view original) {
    size_t i = 0;
    for (char& c : text) {
        if (c != '\n')
            continue;
        i = original.find_first_of("\r\n", i);
        if (i == original.npos)
            return;
        if (original.substr(i).starts_with("\r\n"))
            ++i; // the text still has the CR before it
        c = original[i++];
    }
}

} // namespace

std::optional<std::string> cured(std::string_view text, std::string_view file, std::span<const Cure> cures) {
    text::MappedText whole;
    const std::string plain = with_line_feeds(text);
    whole.append(plain, file, 1);
    const bool has_end = plain.ends_with('\n');
    if (!apply(whole, cures))
        return std::nullopt;
    std::string result = whole.text();
    if (!has_end && result.ends_with('\n'))
        result.pop_back();
    if (plain != text)
        restore_line_ends(result, text);
    return result;
}

bool apply(text::MappedText& text, std::span<const Cure> cures) {
    auto wraps = placed(Lines(text), cures);
    if (!wraps || !leave_out_replaced(*wraps))
        return false;
    text.apply(edits_of(*wraps));
    return true;
}

} // namespace tidemark::glsl
