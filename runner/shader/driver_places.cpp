#include "shader/driver_log.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace tidemark::glsl {
namespace {

using text::Token;
using text::TokenKind;

using Gap = DriverPlaces::Gap;

/// Measures the text between two tokens. `line` is the line of its first character; `put_off` comes from the
/// gap before.
Gap read_gap(std::string_view text, int line, int put_off = 0) {
    Gap gap{0, line, false, 0, put_off};
    for (size_t i = 0; i < text.size();) {
        size_t length = 1;
        const std::string_view rest = text.substr(i);
        if (rest.starts_with("\\\n")) {
            length = 2;
        } else if (rest.starts_with("/*")) {
            const size_t close = rest.find("*/", 2);
            length = close == rest.npos ? rest.size() : close + 2;
            gap.spaced = true;
        } else if (rest.starts_with("//")) {
            for (length = 2; length < rest.size() && rest[length] != '\n';)
                length += rest.substr(length).starts_with("\\\n") ? 2 : 1;
            gap.spaced = true;
        } else if (rest[0] != '\n') {
            gap.spaced = true;
        }
        const std::string_view part = rest.substr(0, length);
        const auto ends = int(std::ranges::count(part, '\n'));
        line += ends;
        gap.put_off += ends;
        if (part == "\n") {
            ++gap.breaks;
            gap.row_line = line;
            gap.spaced = false;
            gap.lines += std::exchange(gap.put_off, 0);
        }
        i += part.size();
    }
    return gap;
}

/// The macros defined at a position, while the position moves down the text.
class Defined {
public:
    enum class What { nothing, empty, object, function, perhaps };

    explicit Defined(const Preprocessed& preprocessed) : macros_(preprocessed.macros) {}

    void walk_to(size_t token) {
        for (; next_ < macros_.size() && macros_[next_].hash < token; ++next_) {
            const MacroLine& macro = macros_[next_];
            What& what = known_[macro.name];
            if (macro.activity != Activity::active)
                what = What::perhaps;
            else
                what = macro.undefines           ? What::nothing
                       : macro.parameters        ? What::function
                       : macro.body == macro.end ? What::empty
                                                 : What::object;
        }
    }

    What what(std::string_view name) const {
        const auto known = known_.find(name);
        if (known != known_.end())
            return known->second;
        return name.starts_with("__") || name.starts_with("GL_") ? What::object : What::nothing;
    }

private:
    const std::vector<MacroLine>& macros_;
    size_t next_ = 0;
    std::unordered_map<std::string_view, What> known_;
};

} // namespace

DriverPlaces::DriverPlaces(std::string_view text)
    : text_(text), tokens_(text::tokenize(text)), preprocessed_(preprocess(tokens_, {})) {
    read_rows();
}

Gap DriverPlaces::gap_before(size_t token, int put_off) const {
    const size_t from = token == 0 ? 0 : tokens_[token - 1].end();
    return read_gap(text_.substr(from, tokens_[token].begin - from), token == 0 ? 1 : tokens_[token - 1].line,
                    put_off);
}

/// Returns one past the `)` that ends the call of the macro at `name`; `name` itself if no arguments follow,
/// so that it is not a call. Returns nothing if no preprocessor accepts it, or if the result depends on the
/// preprocessor.
std::optional<size_t> DriverPlaces::end_of_call(size_t name, bool certain) const {
    int depth = 0;
    bool over_lines = false;
    for (size_t i = name + 1; i < tokens_.size(); ++i) {
        if (tokens_[i].first_on_line && tokens_[i].is("#"))
            break;
        over_lines |= gap_before(i).breaks > 0;
        depth += tokens_[i].is("(") ? 1 : tokens_[i].is(")") ? -1 : 0;
        if (depth > 0)
            continue;
        const bool is_call = tokens_[i].is(")");
        if (over_lines && !(is_call && certain))
            break;
        return is_call ? i + 1 : name;
    }
    return std::nullopt;
}

void DriverPlaces::read_rows() {
    Defined defined(preprocessed_);
    int dropped = 0;
    int put_off = 0;
    size_t call_end = 0;
    bool in_directive = false;
    for (size_t i = 0; i < tokens_.size(); ++i) {
        const Token& token = tokens_[i];
        const Gap gap = gap_before(i, put_off);
        put_off = gap.put_off;
        if (i < call_end) {
            dropped += gap.lines;
        } else if (token.first_on_line || rows_.empty()) {
            rows_.push_back({gap.row_line - dropped, i, i, gap.spaced, tokens_.size()});
            in_directive = token.is("#");
            defined.walk_to(i);
        }
        Row& row = rows_.back();
        row.end = i + 1;
        if (in_directive || token.kind != TokenKind::identifier || i < call_end ||
            preprocessed_.activity[i] == Activity::inactive)
            continue;
        const Defined::What what = defined.what(token.text);
        if (what == Defined::What::nothing)
            continue;
        // The first token of an object's replacement begins where the name was.
        row.known_end = std::min(row.known_end, what == Defined::What::object ? i + 1 : i);
        if (what == Defined::What::object || what == Defined::What::empty)
            continue;
        const auto end = end_of_call(i, what == Defined::What::function);
        if (!end)
            return; // later lines are unknown
        call_end = *end;
    }
}

const DriverPlaces::Row* DriverPlaces::row_at(int line) const {
    const auto row = std::ranges::lower_bound(rows_, line, {}, &Row::line);
    return row != rows_.end() && row->line == line ? &*row : nullptr;
}

DriverPlace DriverPlaces::of_compiler(int line, int column, std::string_view name) const {
    const Row* const row = row_at(line);
    if (!row)
        return {line, 0};
    const auto place_of = [&](size_t token) {
        return DriverPlace{tokens_[token].line, tokens_[token].column};
    };
    int at = row->indented ? 2 : 1;
    for (size_t i = row->begin; i < std::min(row->end, row->known_end) && at <= column; ++i) {
        if (i > row->begin && gap_before(i).spaced)
            ++at;
        if (at == column && (name.empty() || tokens_[i].is(name)))
            return place_of(i);
        at += int(tokens_[i].text.size());
    }
    size_t found = row->end;
    for (size_t i = row->begin; i < row->end && !name.empty(); ++i)
        if (tokens_[i].is(name)) {
            if (found != row->end)
                return {tokens_[row->begin].line, 0};
            found = i;
        }
    return found == row->end ? DriverPlace{tokens_[row->begin].line, 0} : place_of(found);
}

DriverPlace DriverPlaces::of_preprocessor(int line, int column) const {
    const auto token = std::ranges::find_if(
        tokens_, [&](const Token& each) { return each.line == line && each.column == column; });
    return {line, token != tokens_.end() && token->is("#") ? column : 0};
}

} // namespace tidemark::glsl
