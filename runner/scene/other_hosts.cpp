#include "base/encoding.hpp"
#include "base/tokens.hpp"
#include "scene/directives.hpp"
#include "scene/host_uniforms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ranges>
#include <regex>
#include <set>
#include <unordered_map>

namespace tidemark::scene {
namespace {

using text::Token;
using text::TokenKind;

/// Samplers with the picture of the last frame: on glslsandbox.com and twigl, in KodeLife, in Bonzomatic.
constexpr std::string_view k_last_frame_names[] = {"backbuffer", "prevFrame", "texPreviousFrame"};

constexpr std::string_view k_texture_coordinates = "(gl_FragCoord.xy / iResolution.xy)";
/// glslsandbox.com's, before its user has moved the view: y from -0.5 to 0.5.
constexpr std::string_view k_surface_position =
    "((gl_FragCoord.xy / iResolution.xy - 0.5) * vec2(iResolution.x / iResolution.y, 1.0))";

/// Returns the value of a varying that other hosts' vertex shaders write; empty for any other.
std::string_view value_of_varying(std::string_view type, std::string_view name) {
    if (type != "vec2")
        return {};
    if (name == "surfacePosition")
        return k_surface_position;
    const std::string lower = lower_case(std::string(name));
    const bool is_coordinate = lower.find("texcoord") != std::string::npos ||
                               lower.find("tex_coord") != std::string::npos || lower == "uv" ||
                               lower == "vuv" || lower == "v_uv" || lower == "fuv" || lower == "f_uv";
    return is_coordinate ? k_texture_coordinates : std::string_view();
}

bool is_number_type(std::string_view type) {
    return type == "bool" || (find_knob_type(type) && type != "color3");
}

KnobType knob_type_of(std::string_view type) {
    return type == "bool" ? KnobType::int1 : find_knob_type(type)->type;
}

/// A range in the comment after a declaration: `// 0 2`, `// 0.0, 2.0`, `// 0 .. 2`, or Fragmentarium's
/// `slider[0, 0.5, 2]` with the default in the middle.
struct CommentRange {
    double low = 0;
    double high = 0;
    std::optional<double> initial{};
};

std::optional<CommentRange> range_in(std::string_view rest_of_line) {
    static const std::string number = R"(([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?))";
    static const std::regex comment("^\\s*//\\s*\\[?\\s*" + number + R"((?:\s*(?:,|\.\.|to|-)\s*|\s+))" +
                                    number + R"(\s*\]?\s*$)");
    static const std::regex slider("^\\s*slider\\s*\\[\\s*" + number + "\\s*,\\s*" + number + "\\s*,\\s*" +
                                   number + R"(\s*\])");
    constexpr size_t k_longest = 200; // std::regex is recursive
    const std::string line(rest_of_line.substr(0, k_longest));
    const auto value = [](const std::ssub_match& match) {
        const std::string digits = match.str();
        return number_from<double>(digits[0] == '+' ? std::string_view(digits).substr(1) : digits)
            .value_or(0);
    };
    std::smatch found;
    CommentRange range;
    if (std::regex_search(line, found, slider))
        range = {value(found[1]), value(found[3]), value(found[2])};
    else if (std::regex_search(line, found, comment))
        range = {value(found[1]), value(found[2])};
    return range.low < range.high ? std::optional(range) : std::nullopt;
}

/// Reads the declarations of one text.
class Reader {
public:
    Reader(text::MappedText& text, const std::array<bool, k_channel_count>& taken,
           const std::vector<Knob>& declared)
        : text_(text), tokens_(text::tokenize(text.text())), declared_(declared), taken_(taken) {
        for (const Token& token : tokens_)
            if (token.kind == TokenKind::identifier)
                ++uses_[token.text];
        for (size_t i = 0; i < taken_.size(); ++i)
            taken_[i] = taken_[i] || uses_.contains(k_channel_names[i]);
    }

    OtherHosts read() {
        name_dialect();
        count_buffers();
        int depth = 0;
        for (at_ = 0; at_ < tokens_.size(); ++at_) {
            const Token& token = tokens_[at_];
            depth += token.is("{") ? 1 : token.is("}") ? -1 : 0;
            if (depth != 0 || token.kind != TokenKind::identifier)
                continue;
            if (token.is("uniform"))
                read_uniform();
            else if (token.is("varying") || (token.is("in") && starts_declaration()))
                read_varying();
        }
        text_.apply(edits_);
        return std::move(result_);
    }

private:
    const Token& peek(size_t offset) const {
        static const Token k_none;
        return at_ + offset < tokens_.size() ? tokens_[at_ + offset] : k_none;
    }
    SourceLocation place_of(const Token& token) const {
        return text_.lines().locate(token.line, token.column);
    }
    void warn(const Token& at, std::string message) {
        result_.warnings.push_back({place_of(at), Severity::warning, std::move(message)});
    }
    /// Returns whether an `in` begins a global variable, and not a parameter.
    bool starts_declaration() const {
        return at_ == 0 || tokens_[at_ - 1].is(";") || tokens_[at_ - 1].is("}") || tokens_[at_].first_on_line;
    }
    /// Returns the distance from the qualifier to the type, past a precision.
    size_t offset_of_type() const {
        size_t type = 1;
        while (peek(type).is("lowp") || peek(type).is("mediump") || peek(type).is("highp"))
            ++type;
        return type;
    }
    bool is_read(std::string_view name) const { return uses_.at(name) > 1; }

    std::optional<size_t> free_channel() {
        for (size_t i = taken_.size(); i-- > 0;)
            if (!taken_[i]) {
                taken_[i] = true;
                return i;
            }
        return std::nullopt;
    }

    /// Says once which host a text was written for, where that host's own syntax is not read.
    void name_dialect() {
        const std::string_view text = text_.text();
        const size_t first = text.find_first_not_of(" \t\r\n");
        if (first != std::string_view::npos && text.substr(first).starts_with("/*") &&
            text.substr(0, text.find("*/")).find("\"INPUTS\"") != std::string_view::npos) {
            result_.warnings.push_back(
                {text_.lines().locate(1), Severity::warning,
                 "this text is written for ISF: its JSON header is not read. Declare its INPUTS as uniforms, "
                 "and write iTime for TIME, iResolution for RENDERSIZE, gl_FragCoord.xy / iResolution.xy for "
                 "isf_FragNormCoord, texture(iChannel0, uv) for IMG_NORM_PIXEL"});
        }
    }

    /// glslViewer compiles a text once for each `BUFFER_N` that it tests.
    void count_buffers() {
        constexpr size_t k_most = 8;
        while (result_.buffers.size() < k_most &&
               uses_.contains(fmt::format("BUFFER_{}", result_.buffers.size())))
            result_.buffers.emplace_back();
    }

    void read_uniform() {
        const size_t first = at_;
        const size_t type = offset_of_type();
        at_ += type;
        if (peek(0).is("struct") || peek(1).is("{")) {
            read_block();
            return;
        }
        const std::string_view type_name = peek(0).text;
        for (++at_; peek(0).kind == TokenKind::identifier; ++at_) {
            const bool alone = peek(1).is(";") && at_ == first + type + 1;
            if (!name_uniform(first, type_name, alone))
                break;
            if (!peek(0).is(","))
                break;
        }
    }

    /// Handles one declared name and moves to the token after it and its initialiser; false for what is not a
    /// plain variable.
    bool name_uniform(size_t first, std::string_view type, bool alone) {
        const Token& name = peek(0);
        ++at_;
        const bool is_array = peek(0).is("[");
        const std::optional<KnobValue> initial = read_initial(type);
        const bool ends = peek(0).is(";") || peek(0).is(",");
        const bool known = find_host_uniform(name.text, true) || is_host_uniform(name.text) ||
                           std::ranges::find(declared_, name.text, &Knob::name) != declared_.end();
        if (known || !is_read(name.text) || !seen_.insert(name.text).second)
            return ends;
        if (type.starts_with("sampler") || type.starts_with("isampler") || type.starts_with("usampler"))
            read_sampler(first, name, alone && type == "sampler2D");
        else if (is_array || !is_number_type(type))
            warn(name,
                 fmt::format("nothing sets the uniform '{}': it is 0. Tidemark sets uniforms of the types "
                             "float, vec2, vec3, vec4, int, ivec2, ivec3, ivec4 and bool with --set",
                             name.text));
        else if (ends)
            add_knob(name, type, initial);
        return ends;
    }

    /// Reads `= 0.5` or `= vec3(1, 2, 3)`; leaves anything else to the driver.
    std::optional<KnobValue> read_initial(std::string_view type) {
        if (!peek(0).is("="))
            return std::nullopt;
        KnobValue value{};
        size_t count = 0;
        bool negative = false, plain = true;
        int depth = 0;
        for (++at_; at_ < tokens_.size() && !peek(0).is(";") && (depth > 0 || !peek(0).is(",")); ++at_) {
            const Token& token = peek(0);
            depth += token.is("(") ? 1 : token.is(")") ? -1 : 0;
            if (token.kind == TokenKind::number) {
                std::string_view digits = token.text;
                if (digits.ends_with("f") || digits.ends_with("F") || digits.ends_with("u"))
                    digits.remove_suffix(1);
                const auto number = number_from<double>(digits);
                plain = plain && number && count < value.size();
                if (plain)
                    value[count++] = negative ? -*number : *number;
                negative = false;
            } else if (token.is("true") || token.is("false")) {
                value[0] = token.is("true") ? 1 : 0;
                count = 1;
            } else if (token.is("-")) {
                negative = true;
            } else {
                plain = plain &&
                        (token.is("(") || token.is(")") || token.is(",") || token.is("+") || token.is(type));
            }
        }
        if (!plain || count == 0 || !is_number_type(type))
            return std::nullopt;
        const auto components = size_t(info(knob_type_of(type)).components);
        if (count == 1)
            std::fill(value.begin(), value.begin() + std::ptrdiff_t(components), value[0]);
        return count == 1 || count == components ? std::optional(value) : std::nullopt;
    }

    /// Reads a range after the `;` that ends the declaration, and blanks out a slider.
    std::optional<CommentRange> read_range() {
        if (!peek(0).is(";"))
            return std::nullopt;
        const size_t begin = peek(0).end();
        const std::string_view line =
            std::string_view(text_.text()).substr(begin, text_.text().find('\n', begin) - begin);
        if (peek(1).is("slider") && peek(2).is("["))
            for (size_t i = 1; at_ + i < tokens_.size() && peek(i).line == peek(0).line; ++i)
                if (peek(i).is("]")) {
                    edits_.push_back({peek(1).begin, peek(i).end(), {}});
                    break;
                }
        return range_in(line);
    }

    void add_knob(const Token& name, std::string_view type, const std::optional<KnobValue>& initial) {
        Knob knob;
        knob.name = std::string(name.text);
        knob.type = knob_type_of(type);
        knob.plain = true;
        knob.where = place_of(name);
        const std::optional<CommentRange> range = read_range();
        if (initial)
            knob.initial = *initial;
        else if (range && range->initial)
            knob.initial = {*range->initial, *range->initial, *range->initial, *range->initial};
        if (range)
            knob.range = KnobRange{{range->low, range->low, range->low, range->low},
                                   {range->high, range->high, range->high, range->high}};
        else if (type == "bool")
            knob.range = KnobRange{{0, 0, 0, 0}, {1, 1, 1, 1}};
        if (info(knob.type).whole)
            knob.step = KnobValue{1, 1, 1, 1};
        knob.value = knob.initial;
        if (!initial && !(range && range->initial))
            warn(name, fmt::format("nothing sets the uniform '{0}': it is 0. Give it a value with --set "
                                   "{0}=VALUE or in the window's controls",
                                   name.text));
        result_.knobs.push_back(std::move(knob));
    }

    void read_sampler(size_t first, const Token& name, bool alone) {
        std::optional<size_t>* channel = nullptr;
        if (std::ranges::find(k_last_frame_names, name.text) != std::end(k_last_frame_names))
            channel = &result_.last_frame;
        for (size_t i = 0; i < result_.buffers.size(); ++i)
            if (name.text == fmt::format("u_buffer{}", i) || name.text == fmt::format("u_doubleBuffer{}", i))
                channel = &result_.buffers[i];
        if (channel && alone && !*channel)
            *channel = free_channel();
        if (!channel || !alone || !*channel) {
            warn(name,
                 fmt::format("nothing fills the sampler '{}': reads give black. Write iChannel0 for it, "
                             "and name the picture with #iChannel0 \"FILE\"",
                             name.text));
            return;
        }
        edits_.push_back({tokens_[first].begin, peek(0).end(), {}});
        result_.definitions += fmt::format("#define {} {}\n", name.text, k_channel_names[**channel]);
    }

    void read_block() {
        const Token& name = peek(0);
        while (at_ < tokens_.size() && !peek(0).is("}"))
            ++at_;
        while (at_ < tokens_.size() && !peek(0).is(";"))
            ++at_;
        warn(name, fmt::format("nothing fills the uniform block '{}': its members are 0. Declare each as a "
                               "uniform of its own, and use ShaderToy's names (iTime, iResolution) for those "
                               "that a host sets",
                               name.text));
    }

    void read_varying() {
        const size_t first = at_;
        const size_t type = offset_of_type();
        const Token& name = peek(type + 1);
        if (name.kind != TokenKind::identifier || !peek(type + 2).is(";") || !is_read(name.text))
            return;
        const std::string_view value = value_of_varying(peek(type).text, name.text);
        if (value.empty()) {
            warn(name, fmt::format("nothing writes '{}', an output of the vertex shader: it is 0. Compute it "
                                   "from gl_FragCoord",
                                   name.text));
            return;
        }
        at_ += type + 2;
        edits_.push_back({tokens_[first].begin, peek(0).end(), {}});
        result_.definitions += fmt::format("#define {} {}\n", name.text, value);
    }

    text::MappedText& text_;
    const std::vector<Token> tokens_;
    const std::vector<Knob>& declared_;
    std::array<bool, k_channel_count> taken_;
    std::unordered_map<std::string_view, int> uses_;
    std::set<std::string_view> seen_;
    size_t at_ = 0;
    std::vector<text::Edit> edits_;
    OtherHosts result_;
};

} // namespace

OtherHosts read_other_hosts(text::MappedText& text, const std::array<bool, k_channel_count>& taken_channels,
                            const std::vector<Knob>& declared) {
    return Reader(text, taken_channels, declared).read();
}

} // namespace tidemark::scene
