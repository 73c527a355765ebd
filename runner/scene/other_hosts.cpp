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

/// Returns the value of a member of a block that other hosts' vertex shaders write; empty for any other.
std::string_view value_of_input(std::string_view type, std::string_view name) {
    const std::string lower = lower_case(std::string(name));
    if (type == "vec4" && lower.find("position") != std::string::npos)
        return "vec4(2.0 * gl_FragCoord.xy / iResolution.xy - 1.0, 0.0, 1.0)";
    if (type == "vec3" && lower.find("normal") != std::string::npos)
        return "vec3(0.0, 0.0, 1.0)";
    return value_of_varying(type, name);
}

bool is_number_type(std::string_view type) {
    return type == "bool" || (find_knob_type(type) && type != "color3");
}

/// ShaderToy's old name of iTime, which has its value if a text declares it (shader/rewrite.hpp).
constexpr std::string_view k_old_time = "iGlobalTime";

KnobType knob_type_of(std::string_view type) {
    return type == "bool" ? KnobType::int1 : find_knob_type(type)->type;
}

constexpr KnobValue all(double number) {
    return {number, number, number, number};
}

/// Returns the range in the comment after a declaration: `// 0 2`, `// 0.0, 2.0`, `// 0 .. 2`.
std::optional<KnobRange> range_in(std::string_view rest_of_line) {
    static const std::string number = R"(([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?))";
    static const std::regex comment("^\\s*//\\s*\\[?\\s*" + number + R"((?:\s*(?:,|\.\.|to|-)\s*|\s+))" +
                                    number + R"(\s*\]?\s*$)");
    constexpr size_t k_longest = 200; // std::regex is recursive
    const std::string line(rest_of_line.substr(0, k_longest));
    const auto value = [](const std::ssub_match& match) {
        const std::string digits = match.str();
        return number_from<double>(digits[0] == '+' ? std::string_view(digits).substr(1) : digits)
            .value_or(0);
    };
    std::smatch found;
    if (!std::regex_search(line, found, comment) || !(value(found[1]) < value(found[2])))
        return std::nullopt;
    return KnobRange{all(value(found[1])), all(value(found[2]))};
}

/// The widget of a uniform in Fragmentarium: `slider[0, 0.5, 2]`, `slider[(0,0),(1,1),(2,2)]`,
/// `color[1, 0.5, 0]`, `checkbox[true]`, `file[wood.jpg]`.
struct Widget {
    std::optional<KnobValue> initial{};
    std::optional<KnobRange> range{};
    bool is_colour = false;
    std::string_view file{};
};

/// Returns the widget of a uniform with so many components; empty if the numbers do not suit them.
Widget widget_of(std::string_view kind, const std::vector<double>& numbers, size_t components) {
    Widget widget;
    const auto some = [&](size_t first, size_t count) {
        KnobValue value{};
        for (size_t i = 0; i < count; ++i)
            value[i] = numbers[first + i];
        return count == 1 ? all(value[0]) : value;
    };
    if (kind == "slider" && (numbers.size() == 3 || numbers.size() == 3 * components)) {
        const size_t count = numbers.size() / 3;
        widget.initial = some(count, count);
        widget.range = KnobRange{some(0, count), some(2 * count, count)};
    } else if (kind == "color" && numbers.size() == 3 && components == 3) {
        widget.initial = some(0, 3);
        widget.is_colour = true;
    } else if (kind == "color" && numbers.size() == 6 && components == 4) { // a strength, then its colour
        widget.initial = {numbers[3], numbers[4], numbers[5], numbers[1]};
        widget.range = KnobRange{{0, 0, 0, numbers[0]}, {1, 1, 1, numbers[2]}};
    } else if (kind == "checkbox" && numbers.size() == 1) {
        widget.initial = all(numbers[0]);
    }
    const auto is_empty = [&](size_t i) { return !(widget.range->low[i] < widget.range->high[i]); };
    for (size_t i = 0; widget.range && i < components; ++i)
        if (is_empty(i))
            widget.range.reset();
    return widget;
}

/// The lines of a text that only Fragmentarium reads.
struct FragmentariumLines {
    std::optional<int> first{};
    bool vertex_shader = false;
};

/// Blanks out the lines of Fragmentarium that are not GLSL, and its vertex shader.
FragmentariumLines remove_lines_of_fragmentarium(text::MappedText& mapped) {
    constexpr std::string_view k_vertex = "#vertex";
    constexpr std::string_view k_lines[] = {"#group",  "#donotrun",     "#camera",
                                            "#buffer", "#buffershader", "#TexParameter"};
    constexpr std::string_view k_blocks[][2] = {{"#preset", "#endpreset"}, {k_vertex, "#endvertex"}};
    const std::string_view text = mapped.text();
    std::vector<text::Edit> edits;
    FragmentariumLines found;
    std::string_view end_of_block;
    int number = 1;
    for (size_t begin = 0; begin < text.size(); ++number) {
        const size_t end = std::min(text.find('\n', begin), text.size());
        const std::string_view line = trimmed(text.substr(begin, end - begin));
        const std::string_view word = line.substr(0, line.find_first_of(" \t"));
        for (const auto& [opening, closing] : k_blocks)
            if (end_of_block.empty() && word == opening)
                end_of_block = closing;
        if (!end_of_block.empty() || word.starts_with("#info") ||
            std::ranges::find(k_lines, word) != std::end(k_lines)) {
            found.first = found.first.value_or(number);
            found.vertex_shader = found.vertex_shader || word == k_vertex;
            edits.push_back({begin, end, {}});
        }
        if (word == end_of_block)
            end_of_block = {};
        begin = end + 1;
    }
    mapped.apply(edits);
    return found;
}

/// Reads the declarations of one text.
class Reader {
public:
    Reader(text::MappedText& text, const std::array<bool, k_channel_count>& taken,
           const std::vector<Knob>& declared)
        : text_(text), fragmentarium_(remove_lines_of_fragmentarium(text)),
          tokens_(text::tokenize(text.text())), declared_(declared), taken_(taken) {
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
        std::ranges::stable_sort(edits_, {}, &text::Edit::begin);
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
    /// Returns the first token of the declaration at the current one: that of its `layout(…)`, if it has one.
    size_t begin_of_declaration() const {
        size_t begin = at_;
        if (begin == 0 || !tokens_[begin - 1].is(")"))
            return at_;
        for (int depth = 0; begin-- > 0;) {
            depth += tokens_[begin].is(")") ? 1 : tokens_[begin].is("(") ? -1 : 0;
            if (depth == 0)
                break;
        }
        return begin > 0 && begin < at_ && tokens_[begin - 1].is("layout") ? begin - 1 : at_;
    }
    /// Returns whether an `in` begins a global variable, and not a parameter.
    bool starts_declaration() const {
        const size_t begin = begin_of_declaration();
        return begin == 0 || tokens_[begin - 1].is(";") || tokens_[begin - 1].is("}") ||
               tokens_[begin].first_on_line;
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
        const bool complete =
            !fragmentarium_.vertex_shader && (uses_.contains("main") || uses_.contains("mainImage"));
        if (fragmentarium_.first)
            result_.warnings.push_back(
                {text_.lines().locate(*fragmentarium_.first), Severity::warning,
                 fmt::format(
                     "this text is written for Fragmentarium: its sliders are knobs, its lines with # "
                     "and its vertex shader are left out{}",
                     complete ? "" : ". `tidemark help fragmentarium` shows the mainImage that it needs")});
    }

    /// glslViewer compiles a text once for each `BUFFER_N` that it tests.
    void count_buffers() {
        constexpr size_t k_most = 8;
        while (result_.buffers.size() < k_most &&
               uses_.contains(fmt::format("BUFFER_{}", result_.buffers.size())))
            result_.buffers.emplace_back();
    }

    void read_uniform() {
        const size_t begin = begin_of_declaration();
        const size_t first = at_;
        const size_t type = offset_of_type();
        at_ += type;
        if (peek(0).is("struct"))
            return warn_of_block();
        if (peek(1).is("{"))
            return read_block(begin);
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
        const Widget widget = read_widget(type);
        const bool ends = peek(0).is(";") || peek(0).is(",");
        const bool known = find_host_uniform(name.text, true) || is_host_uniform(name.text) ||
                           name.text == k_old_time ||
                           std::ranges::find(declared_, name.text, &Knob::name) != declared_.end();
        if (known || !is_read(name.text) || !seen_.insert(name.text).second)
            return ends;
        if (type.starts_with("sampler") || type.starts_with("isampler") || type.starts_with("usampler"))
            read_sampler(first, name, alone && type == "sampler2D", widget.file);
        else if (is_array || !is_number_type(type))
            warn(name,
                 fmt::format("nothing sets the uniform '{}': it is 0. Tidemark sets uniforms of the types "
                             "float, vec2, vec3, vec4, int, ivec2, ivec3, ivec4 and bool with --set",
                             name.text));
        else if (ends)
            add_knob(name, type, initial, widget);
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

    /// Reads the widget after the `;` that ends a declaration, and blanks it out with what follows it
    /// (`slider[0,1,2] Locked`).
    Widget read_widget(std::string_view type) {
        const Token& kind = peek(1);
        constexpr std::string_view k_kinds[] = {"slider", "color", "checkbox", "file"};
        if (!peek(0).is(";") || !peek(2).is("[") || kind.line != peek(0).line ||
            std::ranges::find(k_kinds, kind.text) == std::end(k_kinds))
            return {};
        std::vector<double> numbers;
        double sign = 1;
        size_t end = 3;
        for (; at_ + end < tokens_.size() && peek(end).line == kind.line && !peek(end).is("]"); ++end) {
            const Token& token = peek(end);
            if (token.kind == TokenKind::number)
                numbers.push_back(sign * number_from<double>(token.text).value_or(0));
            else if (token.is("true") || token.is("false"))
                numbers.push_back(token.is("true") ? 1 : 0);
            sign = token.is("-") ? -1 : 1;
        }
        if (!peek(end).is("]"))
            return {};
        const std::string_view file =
            std::string_view(text_.text()).substr(peek(2).end(), peek(end).begin - peek(2).end());
        while (peek(end + 1).kind == TokenKind::identifier && peek(end + 1).line == kind.line &&
               peek(end + 1).text.find("Lock") != std::string_view::npos)
            ++end;
        edits_.push_back({kind.begin, peek(end).end(), {}});
        if (kind.is("file"))
            return {.file = trimmed(file)};
        return is_number_type(type)
                   ? widget_of(kind.text, numbers, size_t(info(knob_type_of(type)).components))
                   : Widget();
    }

    /// Returns the range in a comment after the `;` that ends the declaration.
    std::optional<KnobRange> read_range() const {
        if (!peek(0).is(";"))
            return std::nullopt;
        const size_t begin = peek(0).end();
        return range_in(std::string_view(text_.text()).substr(begin, text_.text().find('\n', begin) - begin));
    }

    void add_knob(const Token& name, std::string_view type, const std::optional<KnobValue>& initial,
                  const Widget& widget) {
        Knob knob;
        knob.name = std::string(name.text);
        knob.type = widget.is_colour ? KnobType::color3 : knob_type_of(type);
        knob.plain = true;
        knob.where = place_of(name);
        knob.initial = initial ? *initial : widget.initial.value_or(KnobValue{});
        knob.range = widget.range ? widget.range : read_range();
        if (type == "bool")
            knob.range = KnobRange{all(0), all(1)};
        if (info(knob.type).whole)
            knob.step = all(1);
        knob.value = knob.initial;
        if (!initial && !widget.initial)
            warn(name, fmt::format("nothing sets the uniform '{0}': it is 0. Give it a value with --set "
                                   "{0}=VALUE or in the window's controls",
                                   name.text));
        result_.knobs.push_back(std::move(knob));
    }

    void read_sampler(size_t first, const Token& name, bool alone, std::string_view file) {
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
                             "and name the picture with #iChannel0 \"{}\"",
                             name.text, file.empty() ? "FILE" : file));
            return;
        }
        edits_.push_back({tokens_[first].begin, peek(0).end(), {}});
        result_.definitions += fmt::format("#define {} {}\n", name.text, k_channel_names[**channel]);
    }

    /// Makes each member of a block a uniform of its own, and removes the block's name before its members.
    void read_block(size_t begin) {
        const size_t name = at_;
        size_t end = at_ + 2;
        bool plain = true; // members like `float a, b;`
        for (; end < tokens_.size() && !tokens_[end].is("}"); ++end)
            plain = plain && !tokens_[end].is("[") && !tokens_[end].is("{") && !tokens_[end].is("layout");
        const bool named = end + 2 < tokens_.size() && tokens_[end + 1].kind == TokenKind::identifier;
        const size_t last = end + (named ? 2 : 1);
        if (!plain || last >= tokens_.size() || !tokens_[last].is(";"))
            return warn_of_block();
        edits_.push_back({tokens_[begin].begin, tokens_[name + 1].end(), {}});
        edits_.push_back({tokens_[end].begin, tokens_[last].end(), {}});
        bool starts = true;
        for (at_ = name + 2; at_ < end;) {
            const size_t first = at_;
            if (starts)
                edits_.push_back({tokens_[at_].begin, tokens_[at_].begin, "uniform "});
            at_ += peek(0).is("lowp") || peek(0).is("mediump") || peek(0).is("highp") ? 1 : 0;
            const std::string_view type = peek(0).text;
            for (++at_; at_ < end && !peek(0).is(";");)
                if (peek(0).kind != TokenKind::identifier || !name_uniform(first, type, false))
                    ++at_;
            ++at_;
        }
        at_ = last;
        if (named)
            for (size_t i = last; i + 1 < tokens_.size(); ++i)
                if (tokens_[i].is(tokens_[end + 1].text) && tokens_[i + 1].is("."))
                    edits_.push_back({tokens_[i].begin, tokens_[i + 1].end(), {}});
    }

    /// Makes a block that a vertex shader writes, as KodeLife's VertexData, a struct with the values that it
    /// has at a pixel.
    void read_input_block(size_t begin) {
        const size_t name = at_ + 1;
        std::string values;
        size_t end = name + 2;
        for (; end + 2 < tokens_.size() && !tokens_[end].is("}"); end += 3) {
            const std::string_view type = tokens_[end].text;
            const std::string_view value = value_of_input(type, tokens_[end + 1].text);
            if (!tokens_[end + 2].is(";") || value.empty())
                return;
            values += fmt::format("{}{}", values.empty() ? "" : ", ", value);
        }
        if (end + 2 >= tokens_.size() || !tokens_[end + 2].is(";"))
            return;
        edits_.push_back({tokens_[begin].begin, tokens_[at_].end(), "struct"});
        edits_.push_back({tokens_[end + 1].begin, tokens_[end + 1].end(), {}});
        result_.definitions +=
            fmt::format("#define {} {}({})\n", tokens_[end + 1].text, tokens_[name].text, values);
        at_ = end + 2;
    }

    void warn_of_block() {
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
        const size_t first = begin_of_declaration();
        if (peek(1).kind == TokenKind::identifier && peek(2).is("{"))
            return read_input_block(first);
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
    const FragmentariumLines fragmentarium_;
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

std::string_view advice_on_missing_include(std::string_view name) {
    constexpr std::string_view k_helpers[] = {"MathUtils.frag",     "Complex.frag",   "Classic-Noise.frag",
                                              "Ashima-Noise.frag",  "QuilezLib.frag", "Sunsky.frag",
                                              "EmulatedDouble.frag"};
    constexpr std::string_view k_frames[] = {"2D.frag",      "2D-HP.frag",
                                             "2DJulia.frag", "Progressive2D.frag",
                                             "3D.frag",      "Progressive2DJulia.frag",
                                             "Brute3D.frag"};
    if (std::ranges::find(k_helpers, name) != std::end(k_helpers))
        return "It comes with Fragmentarium: copy it from the folder Examples/Include to this place";
    const bool marches = name.ends_with(".frag") && (name.find("-Raytracer") != std::string_view::npos ||
                                                     name.find("-Pathtracer") != std::string_view::npos);
    if (marches || std::ranges::find(k_frames, name) != std::end(k_frames))
        return "It belongs to Fragmentarium and draws with Fragmentarium's vertex shader: `tidemark help "
               "fragmentarium` shows what to write in its place";
    return {};
}

OtherHosts read_other_hosts(text::MappedText& text, const std::array<bool, k_channel_count>& taken_channels,
                            const std::vector<Knob>& declared) {
    return Reader(text, taken_channels, declared).read();
}

} // namespace tidemark::scene
