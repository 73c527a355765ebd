#include "scene/directives.hpp"

#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/tokens.hpp"
#include "scene/host_uniforms.hpp"
#include "scene/names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <unordered_map>

namespace tidemark::scene {
namespace fs = std::filesystem;
using text::Token;
using text::TokenKind;
namespace {

/// VALUE in the grammar: numbers, and whether all of them were written as integers.
struct Value {
    std::vector<double> numbers;
    bool whole = true;
};

/// Values of a channel's `#iChannelN::PARAM` directives, which may come before the directive that names its
/// input.
struct SamplingWishes {
    std::optional<Filter> magnify;
    std::optional<Filter> minify;
    std::optional<Mipmaps> mipmaps;
    std::optional<Wrap> wrap;
    std::optional<bool> vflip;
    bool cubemap = false;
};

/// Returns the channel's sampling: the directives' values, else the defaults of its kind of input
/// (ShaderToy's for kinds that only Tidemark has, the VS Code extension's for pictures).
Sampling sampling_of(const Channel& channel, const SamplingWishes& wishes) {
    Sampling sampling = traits_of(channel.input).sampling;
    sampling.magnify = wishes.magnify.value_or(sampling.magnify);
    sampling.minify = wishes.minify.value_or(sampling.minify);
    sampling.mipmaps = wishes.mipmaps.value_or(sampling.mipmaps);
    sampling.wrap = wishes.wrap.value_or(sampling.wrap);
    sampling.vflip = wishes.vflip.value_or(sampling.vflip);
    return sampling;
}

/// A cursor over the tokens of one text. Each `expect` either advances or fails with a message about what it
/// expected.
class DirectiveReader {
public:
    DirectiveReader(const text::MappedText& text, Conditional conditional)
        : text_(text), conditional_(conditional), tokens_(text::tokenize(text.text())) {}

    Result<Directives> read_all();
    const std::vector<text::Edit>& edits() const { return edits_; }

private:
    using Status = Result<void>;

    // Tokens
    const Token* peek() const { return position_ < tokens_.size() ? &tokens_[position_] : nullptr; }
    bool next_is(std::string_view wanted) const { return peek() && peek()->is(wanted); }
    bool accept(std::string_view wanted) { return next_is(wanted) && ++position_; }
    SourceLocation here() const;
    SourceLocation place_of(const Token& token) const {
        return text_.lines().locate(token.line, token.column);
    }
    bool at_end() const;
    tl::unexpected<Error> wanted(std::string_view what) const;
    Status open_bracket(std::string_view open, std::string_view close);
    Status close_bracket(std::string_view close);
    Status expect(std::string_view wanted_text);
    Result<std::string> expect_string();

    // Grammar
    bool at_directive() const;
    void follow_conditionals();
    Status check_spelling() const;
    Status read_directive();
    Status read_channel(std::string_view keyword, const SourceLocation& where);
    Status read_channel_source(size_t number, const SourceLocation& where);
    Status read_channel_parameter(SamplingWishes& wishes);
    Status read_size(const SourceLocation& where);
    Status read_knob(const SourceLocation& where);
    Status read_knob_values(Knob& knob);
    Status check_name_is_free(const Knob& knob) const;
    Result<KnobRange> read_range(const Knob& knob);
    Result<KnobValue> read_value(const Knob& knob);
    Result<Value> read_literal();
    Result<double> read_number(bool& whole);

    const text::MappedText& text_;
    const Conditional conditional_;
    int depth_ = 0; ///< nesting of #if
    std::vector<Token> tokens_;
    size_t position_ = 0;
    int brackets_ = 0; ///< number of open ones
    Directives directives_;
    std::unordered_map<std::string, size_t> knob_of_name_;
    std::array<SamplingWishes, k_channel_count> wishes_;
    std::vector<text::Edit> edits_;
};

/// A directive ends with its line, except inside brackets.
bool DirectiveReader::at_end() const {
    return !peek() || (peek()->first_on_line && brackets_ == 0);
}

/// Returns the place of the next token; at the end, the place after the last one.
SourceLocation DirectiveReader::here() const {
    if (!at_end())
        return place_of(*peek());
    const Token& last = tokens_[position_ - 1];
    return text_.lines().locate(last.line, last.column + int(last.text.size()));
}

tl::unexpected<Error> DirectiveReader::wanted(std::string_view what) const {
    const std::string found = !peek()    ? "the end of the file"
                              : at_end() ? "the end of the line"
                                         : fmt::format("'{}'", peek()->text);
    return fail(error_at(here(), fmt::format("expected {} but found {}", what, found)));
}

/// Looks for the closing bracket first: an error about a missing one would otherwise point lines too far
/// down.
Result<void> DirectiveReader::open_bracket(std::string_view open, std::string_view close) {
    const Token* bracket = peek();
    TRY(expect(open));
    const auto ends_it = [&](const Token& token) {
        return token.is(close) || token.is(open) || token.is("{") || token.is(";") || token.is("#");
    };
    const auto end = std::find_if(tokens_.begin() + std::ptrdiff_t(position_), tokens_.end(), ends_it);
    const bool closed = end != tokens_.end() && end->is(close);
    if (!closed && (end != tokens_.end() ? *end : tokens_.back()).line > bracket->line)
        return fail(
            error_at(place_of(*bracket), fmt::format("'{}' is not closed: '{}' is missing", open, close)));
    ++brackets_;
    return {};
}

Result<void> DirectiveReader::close_bracket(std::string_view close) {
    TRY(expect(close));
    --brackets_;
    return {};
}

Result<void> DirectiveReader::expect(std::string_view wanted_text) {
    if (!accept(wanted_text))
        return wanted(fmt::format("'{}'", wanted_text));
    return {};
}

Result<std::string> DirectiveReader::expect_string() {
    if (!peek() || peek()->kind != TokenKind::string)
        return wanted("a name in quotes");
    const std::string_view quoted = tokens_[position_++].text;
    std::string name;
    for (size_t i = 1; i + 1 < quoted.size(); ++i) {
        if (quoted[i] == '\\' && (quoted[i + 1] == '"' || quoted[i + 1] == '\\'))
            ++i; // any other backslash is one of a path, which then gets a hint
        name += quoted[i];
    }
    return name;
}

bool DirectiveReader::at_directive() const {
    if (!next_is("#") || position_ + 1 >= tokens_.size() || !tokens_[position_ + 1].glued)
        return false;
    const std::string_view keyword = tokens_[position_ + 1].text;
    return keyword.starts_with("iChannel") || keyword == "iUniform" || keyword == "iKeyboard" ||
           keyword == "iVertex" || keyword == "iSize" || keyword == "iFirstPersonControls" ||
           keyword == "StrictCompatibility";
}

void DirectiveReader::follow_conditionals() {
    if (!next_is("#") || !peek()->first_on_line || position_ + 1 >= tokens_.size())
        return;
    const Token& keyword = tokens_[position_ + 1];
    if (keyword.is("if") || keyword.is("ifdef") || keyword.is("ifndef"))
        ++depth_;
    else if (keyword.is("endif"))
        depth_ = std::max(0, depth_ - 1);
}

/// Refuses a misspelled directive, such as `#iUnifrom`.
Result<void> DirectiveReader::check_spelling() const {
    if (!next_is("#") || !peek()->first_on_line || position_ + 1 >= tokens_.size() || depth_ > 0)
        return {};
    const std::string_view keyword = tokens_[position_ + 1].text;
    if (keyword.size() < 4 || (keyword[0] != 'i' && keyword[0] != 'I') || keyword == "include")
        return {};
    const std::string_view name = keyword.substr(0, keyword.find_first_of("0123456789"));
    const std::string meant =
        nearest_name(name, {"iUniform", "iKeyboard", "iVertex", "iSize", "iFirstPersonControls", "iChannel",
                            "ifdef", "ifndef", "include"});
    if (!meant.starts_with("i") || meant == name || meant == "ifdef" || meant == "ifndef" ||
        meant == "include")
        return {};
    return fail(error_at(place_of(*peek()), fmt::format("there is no directive '#{}': did you mean '#{}{}'?",
                                                        keyword, meant, keyword.substr(name.size()))));
}

Result<Directives> DirectiveReader::read_all() {
    while (peek()) {
        follow_conditionals();
        if (conditional_ == Conditional::read && !at_directive())
            TRY(check_spelling());
        if (!at_directive() || (depth_ > 0 && conditional_ == Conditional::leave)) {
            ++position_;
            continue;
        }
        const size_t begin = tokens_[position_].begin;
        TRY(read_directive());
        edits_.push_back({begin, tokens_[position_ - 1].end(), {}});
    }
    for (size_t i = 0; i < wishes_.size(); ++i) {
        Channel& channel = directives_.channels[i];
        if (const std::string& source = directives_.sources[i]; !source.empty())
            channel.input = input_of_name(source, fs::path(channel.where.file).parent_path(),
                                          wishes_[i].cubemap ? PictureAs::cubemap : PictureAs::flat);
        channel.sampling = sampling_of(channel, wishes_[i]);
    }
    return std::move(directives_);
}

Result<void> DirectiveReader::read_directive() {
    const SourceLocation where = text_.lines().locate(peek()->line);
    ++position_;
    const std::string_view keyword = tokens_[position_++].text;
    if (keyword.starts_with("iChannel"))
        return read_channel(keyword, where);
    if (keyword == "iUniform")
        return read_knob(where);
    if (keyword == "iSize")
        return read_size(where);
    // Tidemark always does what it requests: our own main() calls mainImage
    if (keyword == "StrictCompatibility")
        return {};
    if (keyword == "iKeyboard") {
        directives_.keyboard_helpers = true;
        return {};
    }
    if (keyword == "iFirstPersonControls") {
        directives_.moves_view = true;
        directives_.warnings.push_back({where, Severity::warning,
                                        "#iFirstPersonControls: mouse and wheel move iViewMatrix around the "
                                        "point in view; keys do not move it"});
        return {};
    }
    auto name = expect_string(); // #iVertex
    if (!name)
        return fail(std::move(name.error()));
    if (*name != "default")
        directives_.warnings.push_back(
            {where, Severity::warning, "#iVertex is ignored: every pass is drawn as one triangle"});
    return {};
}

Result<void> DirectiveReader::read_channel(std::string_view keyword, const SourceLocation& where) {
    const std::string_view digits = keyword.substr(std::string_view("iChannel").size());
    if (digits.size() != 1 || digits[0] < '0' || digits[0] >= '0' + k_channel_count)
        return fail(error_at(where, fmt::format("#{}: the channels are iChannel0 to iChannel{}", keyword,
                                                k_channel_count - 1)));
    const auto channel = size_t(digits[0] - '0');
    if (!accept(":"))
        return read_channel_source(channel, where);
    TRY(expect(":"));
    return read_channel_parameter(wishes_[channel]);
}

Result<void> DirectiveReader::read_channel_source(size_t number, const SourceLocation& where) {
    if (!at_end() && peek()->kind != TokenKind::string && !next_is("\"") && !next_is("'")) {
        const std::string_view line = text::line_of(text_.text(), peek()->line);
        std::string_view rest = line.substr(size_t(peek()->column - 1));
        rest = rest.substr(0, rest.find_first_of(" \t\r"));
        return fail(error_at(here(), fmt::format("the name needs quotes: #iChannel{} \"{}\"", number, rest)));
    }
    auto name = TRY(expect_string());
    if (name.starts_with("file://"))
        name.erase(0, std::string_view("file://").size());
    if (name.find("://") != std::string::npos)
        return fail(
            error_at(where, fmt::format("'{}' is not a local file: tidemark does not download files", name)));
    if (name.empty())
        return fail(error_at(where, "the name of the picture is empty"));
    Channel& channel = directives_.channels[number];
    channel.where = where;
    directives_.sources[number] = std::move(name);
    return {};
}

Result<void> DirectiveReader::read_channel_parameter(SamplingWishes& wishes) {
    struct MinFilter {
        std::string_view name;
        Filter filter;
        Mipmaps mipmaps;
    };
    constexpr MinFilter k_min_filters[] = {
        {"Nearest", Filter::nearest, Mipmaps::none},
        {"NearestMipMapNearest", Filter::nearest, Mipmaps::nearest},
        {"NearestMipMapLinear", Filter::nearest, Mipmaps::linear},
        {"Linear", Filter::linear, Mipmaps::none},
        {"LinearMipMapNearest", Filter::linear, Mipmaps::nearest},
        {"LinearMipMapLinear", Filter::linear, Mipmaps::linear},
    };
    constexpr std::pair<std::string_view, Wrap> k_wraps[] = {
        {"Repeat", Wrap::repeat}, {"Clamp", Wrap::clamp}, {"Mirror", Wrap::mirror}};

    if (!peek())
        return wanted("MinFilter, MagFilter, WrapMode, VFlip or Type");
    const SourceLocation where = here();
    const std::string parameter(tokens_[position_++].text);
    auto value = TRY(expect_string());
    if (parameter == "MinFilter") {
        for (const MinFilter& filter : k_min_filters)
            if (filter.name == value) {
                wishes.minify = filter.filter;
                wishes.mipmaps = filter.mipmaps;
                return {};
            }
        return fail(error_at(where, fmt::format("MinFilter \"{}\": give Nearest, Linear, or one of the two "
                                                "followed by MipMapNearest or MipMapLinear",
                                                value)));
    }
    if (parameter == "MagFilter") {
        if (value != "Nearest" && value != "Linear")
            return fail(error_at(where, fmt::format("MagFilter \"{}\": give Nearest or Linear", value)));
        wishes.magnify = value == "Nearest" ? Filter::nearest : Filter::linear;
        return {};
    }
    if (parameter == "WrapMode") {
        for (const auto& [name, wrap] : k_wraps)
            if (name == value) {
                wishes.wrap = wrap;
                return {};
            }
        return fail(error_at(where, fmt::format("WrapMode \"{}\": give Repeat, Clamp or Mirror", value)));
    }
    if (parameter == "Type") {
        wishes.cubemap = value == "CubeMap";
        if (value != "Texture2D" && value != "CubeMap")
            return fail(error_at(where, fmt::format("Type \"{}\": give Texture2D or CubeMap", value)));
        return {};
    }
    if (parameter == "VFlip") {
        if (value != "true" && value != "false")
            return fail(error_at(where, fmt::format("VFlip \"{}\": give true or false", value)));
        wishes.vflip = value == "true";
        return {};
    }
    return fail(error_at(
        where, fmt::format("unknown parameter '{}': give MinFilter, MagFilter, WrapMode, VFlip or Type",
                           parameter)));
}

/// `800x450` is several tokens: a number and those glued to it.
Result<void> DirectiveReader::read_size(const SourceLocation& where) {
    if (at_end())
        return wanted("a size in pixels, as in 800x450");
    const SourceLocation place = here();
    std::string text;
    do {
        text += tokens_[position_++].text;
    } while (!at_end() && peek()->glued);
    const auto extent = size_of_text(text);
    if (!extent)
        return fail(
            error_at(place, fmt::format("'{}' is not a size: give WIDTHxHEIGHT in pixels, each from 1 to "
                                        "{}, as in #iSize 800x450",
                                        text, k_largest_stated_side)));
    directives_.sizes.push_back({*extent, where});
    return {};
}

Result<void> DirectiveReader::read_knob(const SourceLocation& where) {
    Knob knob;
    knob.where = where;
    const KnobTypeInfo* type = peek() ? find_knob_type(peek()->text) : nullptr;
    if (!type)
        return wanted("a type (float, vec2, vec3, vec4, color3, int, ivec2, ivec3 or ivec4)");
    knob.type = type->type;
    ++position_;
    if (!peek() || peek()->kind != TokenKind::identifier)
        return wanted("the name of the uniform");
    knob.name = std::string(tokens_[position_++].text);
    TRY(check_name_is_free(knob));
    TRY(read_knob_values(knob));
    knob_of_name_.emplace(knob.name, directives_.knobs.size());
    directives_.knobs.push_back(std::move(knob));
    return {};
}

Result<void> DirectiveReader::check_name_is_free(const Knob& knob) const {
    if (is_host_uniform(knob.name))
        return fail(error_at(
            knob.where,
            fmt::format("'{}' is a uniform that the host provides: give the knob another name", knob.name)));
    const auto same = knob_of_name_.find(knob.name);
    if (same == knob_of_name_.end())
        return {};
    Error error = error_at(knob.where, fmt::format("the knob '{}' is declared twice", knob.name));
    error.diagnostics.push_back(
        {directives_.knobs[same->second].where, Severity::note, "first declared here"});
    return fail(std::move(error));
}

Result<void> DirectiveReader::read_knob_values(Knob& knob) {
    const bool has_default = accept("=");
    if (has_default) {
        const auto value = TRY(read_value(knob));
        knob.value = value;
    }
    if (accept("in")) {
        const auto range = TRY(read_range(knob));
        knob.range = range;
    }
    if (accept("step")) {
        const auto step = TRY(read_value(knob));
        knob.step = step;
    } else if (info(knob.type).whole) {
        knob.step = KnobValue{1, 1, 1, 1};
    }
    if (!has_default && !knob.range)
        return fail(
            error_at(knob.where, fmt::format("the knob '{}' needs a default (= VALUE) or a range (in {{ "
                                             "LOW, HIGH }})",
                                             knob.name)));
    if (!has_default)
        knob.value = knob.range->low;
    for (size_t i = 0; knob.range && i < size_t(info(knob.type).components); ++i)
        if (knob.value[i] < knob.range->low[i] || knob.value[i] > knob.range->high[i])
            return fail(
                error_at(knob.where, fmt::format("the default of '{}' is {}, outside of its range {} to {}",
                                                 knob.name, to_string(knob), to_string(knob, knob.range->low),
                                                 to_string(knob, knob.range->high))));
    knob.initial = knob.value;
    return {};
}

Result<KnobRange> DirectiveReader::read_range(const Knob& knob) {
    const SourceLocation where = here();
    const bool square = next_is("[");
    if (!square && !next_is("{"))
        return wanted("'{' or '['");
    TRY(open_bracket(square ? "[" : "{", square ? "]" : "}"));
    const auto low = TRY(read_value(knob));
    TRY(expect(","));
    const auto high = TRY(read_value(knob));
    if (auto closed = close_bracket(square ? "]" : "}"); !closed)
        return fail(closed.error());
    for (size_t i = 0; i < size_t(info(knob.type).components); ++i)
        if (low[i] > high[i])
            return fail(error_at(
                where, fmt::format("the range of '{}' is reversed: give the lower value first", knob.name)));
    return KnobRange{low, high};
}

Result<KnobValue> DirectiveReader::read_value(const Knob& knob) {
    const SourceLocation where = here();
    const auto literal = TRY(read_literal());
    const KnobTypeInfo& type = info(knob.type);
    const auto components = size_t(type.components);
    if (literal.numbers.size() != 1 && literal.numbers.size() != components)
        return fail(error_at(where, fmt::format("'{}' is a {}: it takes {}", knob.name, type.directive_name,
                                                components == 1
                                                    ? "one number"
                                                    : fmt::format("{} numbers or one for all", components))));
    if (type.whole && !literal.whole)
        return fail(error_at(
            where, fmt::format("'{}' is an {}: it takes whole numbers", knob.name, type.directive_name)));
    for (const double number : literal.numbers)
        if (type.whole && !fits_int(number))
            return fail(error_at(where, fmt::format("'{}' is an {}: {:.0f} does not fit", knob.name,
                                                    type.directive_name, number)));
    KnobValue value{};
    for (size_t i = 0; i < components; ++i)
        value[i] = literal.numbers[literal.numbers.size() == 1 ? 0 : i];
    return value;
}

Result<Value> DirectiveReader::read_literal() {
    Value value;
    const bool constructor = peek() && find_knob_type(peek()->text) != nullptr;
    if (constructor) {
        ++position_;
        TRY(open_bracket("(", ")"));
    }
    do {
        const auto number = TRY(read_number(value.whole));
        value.numbers.push_back(number);
    } while (constructor && accept(","));
    if (constructor)
        TRY(close_bracket(")"));
    return value;
}

Result<double> DirectiveReader::read_number(bool& whole) {
    const bool negative = next_is("-");
    if (negative || next_is("+"))
        ++position_;
    if (!peek() || peek()->kind != TokenKind::number)
        return wanted("a number");
    const std::string_view digits = peek()->text;
    const auto number = number_from<double>(digits);
    if (!number)
        return wanted("a decimal number");
    ++position_;
    whole = whole && digits.find_first_of(".eE") == std::string_view::npos;
    return negative ? -*number : *number;
}

} // namespace

Result<Directives> take_directives(text::MappedText& text, Conditional conditional) {
    DirectiveReader reader(text, conditional);
    auto directives = reader.read_all();
    if (directives)
        text.apply(reader.edits());
    return directives;
}

} // namespace tidemark::scene
