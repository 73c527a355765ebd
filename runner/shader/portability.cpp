#include "shader/portability.hpp"

#include "scene/channel.hpp"
#include "scene/host_uniforms.hpp"
#include "shader/builtin_functions.hpp"
#include "shader/token_reading.hpp"
#include "shader/tree_facts.hpp"
#include "shader/variables.hpp"
#include "shader/vocabulary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string>
#include <unordered_map>
#include <unordered_set>

namespace tidemark::glsl {
namespace {

using text::Token;
using text::TokenKind;

/// Reserved by GLSL ES 3.00 (section 3.8); desktop drivers may accept them as names.
constexpr std::string_view k_es_reserved[] = {
    "attribute",   "varying",       "coherent",  "restrict",      "readonly",      "writeonly", "resource",
    "atomic_uint", "noperspective", "patch",     "sample",        "subroutine",    "common",    "partition",
    "active",      "asm",           "class",     "union",         "enum",          "typedef",   "template",
    "this",        "goto",          "inline",    "noinline",      "volatile",      "public",    "static",
    "extern",      "external",      "interface", "long",          "short",         "half",      "fixed",
    "unsigned",    "superp",        "input",     "output",        "filter",        "sizeof",    "cast",
    "namespace",   "using",         "sampler1D", "sampler2DRect", "samplerBuffer", "image2D",   "image3D",
    "hvec2",       "hvec3",         "hvec4",     "fvec2",         "fvec3",         "fvec4"};

/// Functions that are neither in current GLSL nor in an old API.
constexpr OldName k_other_functions[] = {
    {"noise1", "a function of your own"},
    {"noise2", "a function of your own"},
    {"noise3", "a function of your own"},
    {"noise4", "a function of your own"},
    // declared by #iKeyboard
    {"isKeyDown", "texelFetch(iChannel0, ivec2(key, 0), 0).x"},
    {"isKeyPressed", "texelFetch(iChannel0, ivec2(key, 1), 0).x"},
    {"isKeyToggled", "texelFetch(iChannel0, ivec2(key, 2), 0).x"},
    {"isKeyReleased", "a buffer that remembers isKeyDown"},
};

/// Functions of GLSL ES 3.00 that Chromium's compiler lets a text redefine, with any parameters (checked in
/// November 2026); it rejects all others.
constexpr std::string_view k_may_be_defined_again[] = {"mix",         "texelFetch", "texture",
                                                       "textureGrad", "textureLod", "textureSize"};

/// Texture functions with an offset; WebGL 2 allows offsets from -8 to 7.
constexpr std::string_view k_with_offset[] = {
    "textureOffset",     "texelFetchOffset",     "textureLodOffset",     "textureProjOffset",
    "textureGradOffset", "textureProjLodOffset", "textureProjGradOffset"};
constexpr int k_least_offset = -8, k_largest_offset = 7;

/// Returns the replacement in GLSL ES 3.00 for a function that it lacks; empty if it has the function, or if
/// none is known.
std::string_view instead_of(std::string_view function) {
    if (const BuiltinFunction* const builtin = find_builtin(function))
        return builtin->instead;
    for (const std::span<const OldName> names : {std::span<const OldName>(k_other_functions), {k_old_names}})
        if (const auto found = std::ranges::find(names, function, &OldName::name); found != names.end())
            return found->today;
    return {};
}

/// Returns the row of a uniform that the site declares in passes that draw pictures; null for other names.
const scene::HostUniform* site_uniform(std::string_view name) {
    const scene::HostUniform* row = scene::find_host_uniform(name);
    return row && row->declared == scene::Declared::by_site && row->image ? row : nullptr;
}

bool is_site_channel(std::string_view name) {
    return is_one_of(name, std::span(k_channel_names).first<scene::k_site_channel_count>());
}

/// Returns whether the site declares the name in passes that draw pictures.
bool is_on_site(std::string_view name) {
    return site_uniform(name) != nullptr || is_site_channel(name);
}

/// Returns whether the site declares the name in those passes, but not where it compiles Common by itself.
bool is_missing_in_common(std::string_view name) {
    const scene::HostUniform* row = site_uniform(name);
    return (row && !row->common) || is_site_channel(name);
}

bool is_whole_number(const Token& token) {
    return token.kind == TokenKind::number &&
           token.text.find_first_not_of("0123456789") == std::string_view::npos;
}

/// Lints one text: Common, or a pass.
class Linter {
public:
    Linter(const text::MappedText& text, bool common)
        : text_(text), tokens_(text::tokenize(text.text())), read_(preprocess(tokens_)), common_(common) {}

    /// Adds the names that `other` defines.
    void know(const Linter& other) {
        defined_.insert(other.defined_.begin(), other.defined_.end());
        macros_.insert(other.macros_.begin(), other.macros_.end());
        opens_.insert(other.opens_.begin(), other.opens_.end());
    }

    std::vector<Diagnostic> run() {
        note_definitions();
        for (const size_t hash : read_.directives)
            directive(hash);
        std::unordered_set<std::string_view> named;
        for (const size_t i : read_.code)
            named.insert(tokens_[i].text);
        for (const MacroLine& macro : read_.macros)
            for (size_t i = macro.body; i < macro.end; ++i) {
                everywhere(tokens_[i]);
                if (i + 1 < macro.end && tokens_[i + 1].is("(") && named.contains(macro.name))
                    missing_function(tokens_[i]);
            }
        for (at_ = 0; at_ < read_.code.size(); ++at_)
            code();
        std::stable_sort(found_.begin(), found_.end(),
                         [](const auto& a, const auto& b) { return a.first < b.first; });
        std::vector<Diagnostic> diagnostics;
        for (auto& [place, diagnostic] : found_)
            diagnostics.push_back(std::move(diagnostic));
        return diagnostics;
    }

private:
    const Token& peek(long offset) const {
        static const Token k_none;
        const long i = long(at_) + offset;
        return i < 0 || size_t(i) >= read_.code.size() ? k_none : tokens_[read_.code[size_t(i)]];
    }
    bool is_word(long offset) const { return peek(offset).kind == TokenKind::identifier; }

    void say(const Token& token, std::string message) {
        found_.emplace_back(token.begin, Diagnostic{text_.lines().locate(token.line, token.column),
                                                    Severity::warning, std::move(message)});
    }

    /// Collects the text's own functions and macros.
    void note_definitions() {
        for (const MacroLine& macro : read_.macros) {
            defined_.insert(macro.name);
            macros_.insert(macro.name);
            int opens = 0;
            for (size_t i = macro.body; i < macro.end; ++i)
                opens += tokens_[i].is("{") ? 1 : tokens_[i].is("}") ? -1 : 0;
            if (opens != 0)
                opens_[macro.name] = opens;
        }
        for (at_ = 0; at_ < read_.code.size(); ++at_) {
            if (is_word(0) && is_word(-1) && peek(1).is("(") && !peek(-1).is("return") &&
                !peek(-1).is("else"))
                defined_.insert(peek(0).text);
        }
    }

    void directive(size_t hash) {
        if (hash + 2 >= tokens_.size())
            return;
        const Token& keyword = tokens_[hash + 1];
        if (keyword.is("extension"))
            say(tokens_[hash],
                fmt::format(
                    "#extension {}: the site enables the extensions of WebGL 2 itself; remove this line",
                    tokens_[hash + 2].text));
        else if (keyword.is("version"))
            say(tokens_[hash], "#version: the site adds that line itself; remove it");
        else if (keyword.is("include"))
            say(tokens_[hash], "#include: the site has no files; paste the text, or use Common");
    }

    /// Checks a token whose problems do not depend on context, in macros as well.
    void everywhere(const Token& token) {
        if (token.kind == TokenKind::number)
            number(token);
        else if (token.kind == TokenKind::identifier)
            word(token);
        else
            character(token);
    }

    /// Each byte of a multi-byte character is a token; only the first one is reported.
    void character(const Token& token) {
        if (const auto strange = strange_character(std::string_view(text_.text()).substr(token.begin)))
            say(token,
                strange->blank
                    ? fmt::format("{} in the code: the site refuses it; write a space", strange->name)
                    : fmt::format("{} is not a character of GLSL: {}", strange->name, advice_on(*strange)));
    }

    void number(const Token& token) {
        const std::string_view digits = token.text;
        if (digits.ends_with("lf") || digits.ends_with("LF"))
            say(token, fmt::format("{}: GLSL ES has no double precision; write {}", digits,
                                   digits.substr(0, digits.size() - 2)));
    }

    /// Reports the declaration of a uniform that only this host sets.
    void host_uniform() {
        const scene::HostUniform* row = scene::find_host_uniform(peek(0).text);
        if (!row || !row->breaks_as_zero)
            return;
        long i = -1;
        while (!peek(i).text.empty() && !peek(i).is(";") && !peek(i).is("}") && !peek(i).is("uniform"))
            --i;
        if (peek(i).is("uniform") && reported_.insert(row->name).second)
            say(peek(0),
                fmt::format("{}: the site has no such uniform, and it is all zeros there", row->name));
    }

    void word(const Token& token) {
        if (const std::string_view single = float_type_of(token.text); !single.empty())
            say(token, fmt::format("{}: GLSL ES has no double precision; write {}", token.text, single));
    }

    void code() {
        const Token& token = peek(0);
        if (token.is("{") && braces_ == 0)
            in_function_ = peek(-1).is(")");
        if (token.is("{"))
            ++braces_;
        else if (token.is("}"))
            braces_ = std::max(0, braces_ - 1);
        else if (const auto macro = opens_.find(token.text); macro != opens_.end())
            braces_ = std::max(0, braces_ + macro->second);
        else if (token.is(";") && braces_ == 0 && stands_for_nothing())
            say(token, "; alone: GLSL ES 3.00 does not allow it outside functions; remove it");
        else if (token.is("=") && !peek(1).is("=") && is_call_before())
            say(token, "a value is assigned to a function's result: GLSL ES 3.00 refuses that");
        if (token.is("{") && peek(-1).is("="))
            say(token,
                "= {: GLSL ES 3.00 has no initialiser lists; write a constructor, as in float[](1.0, 2.0)");
        everywhere(token);
        if (token.kind != TokenKind::identifier)
            return;
        host_uniform();
        if (!peek(-1).is(".")) {
            reserved();
            calls();
        }
        declaration();
        if (braces_ == 0)
            global();
        if (token.text.find("__") != token.text.npos || token.text.starts_with("webgl_") ||
            token.text.starts_with("_webgl_"))
            reserved_name();
        if (is_one_of(token.text, k_with_offset))
            offset();
        if (common_ && is_missing_in_common(token.text) && !defined_.contains(token.text) && !is_local())
            say(token, fmt::format("{}: the site compiles Common alone, where this is not declared; pass it "
                                   "as a parameter, or use a macro",
                                   token.text));
    }

    /// Returns whether the semicolon follows a function, another semicolon or the beginning of the text.
    bool stands_for_nothing() const {
        return at_ == 0 || peek(-1).is(";") || (peek(-1).is("}") && in_function_);
    }

    /// Matches `h() = 1.0`, but not `(x) = 1.0`. Returns false for macros, which may stand for anything.
    bool is_call_before() const {
        if (!peek(-1).is(")"))
            return false;
        long i = -1;
        for (int depth = 0; !peek(i).text.empty(); --i) {
            depth += peek(i).is(")") ? 1 : peek(i).is("(") ? -1 : 0;
            if (depth == 0)
                break;
        }
        const Token& name = peek(i - 1);
        return name.kind == TokenKind::identifier && !is_keyword(name.text) && !macros_.contains(name.text) &&
               braces_ > 0;
    }

    void reserved_name() {
        const Token& token = peek(0);
        if (!macros_.contains(token.text) && !token.text.starts_with("__") &&
            reported_.insert(token.text).second)
            say(token, fmt::format("{}: names that contain two underscores in a row or begin with webgl_ are "
                                   "reserved on the site",
                                   token.text));
    }

    /// Checks `uniform vec3 iResolution;`, `float iTime = 0.0;`, `out vec4 second;`, `vec4 mainImage(…)`,
    /// outside of functions.
    void global() {
        const Token& token = peek(0);
        const bool first_word = peek(-1).is(";") || peek(-1).is("}") || at_ == 0 || peek(-1).is(")");
        if (token.is("out") && first_word && !in_parentheses())
            say(token, "out: the site declares the output itself and allows no second one");
        const bool declares = is_word(-1) && !peek(-1).is("struct") &&
                              (peek(1).is(";") || peek(1).is("=") || peek(1).is(",") || peek(1).is("["));
        const bool is_of_the_site =
            is_on_site(token.text) ||
            std::ranges::find(scene::k_channel_structs, token.text) != scene::k_channel_structs.end();
        if (declares && is_of_the_site && !common_ && !in_parameters())
            say(token, fmt::format("{}: the site declares it already; remove this", token.text));
        if (token.is("mainImage") && peek(1).is("(") && is_word(-1))
            signature();
    }

    /// Returns whether the token is among a function's parameters, where any name is allowed.
    bool in_parameters() const {
        int depth = 0;
        for (long i = -1; !peek(i).text.empty() && !peek(i).is(";") && !peek(i).is("}"); --i)
            depth += peek(i).is("(") ? 1 : peek(i).is(")") ? -1 : 0;
        return depth > 0;
    }

    /// Checks a definition against ShaderToy's declaration `void mainImage(out vec4, in vec2)`.
    void signature() {
        constexpr std::string_view k_precisions[] = {"highp", "mediump", "lowp"};
        std::string parameters;
        long i = 2;
        for (; !peek(i).text.empty() && !peek(i).is(")") && !peek(i).is("("); ++i)
            if (!is_one_of(peek(i).text, k_precisions))
                parameters += std::string(peek(i).text) + " ";
        if (!peek(i).is(")") || !peek(i + 1).is("{"))
            return; // only declared, or something else
        const size_t comma = parameters.find(", ");
        const std::string_view first = std::string_view(parameters).substr(0, comma);
        const std::string_view second =
            comma == parameters.npos ? std::string_view() : std::string_view(parameters).substr(comma + 2);
        const bool same = peek(-1).is("void") && first.starts_with("out vec4 ") &&
                          (second.starts_with("in vec2 ") || second.starts_with("vec2 "));
        if (!same && !has_macro(parameters))
            say(peek(0), "mainImage: the site declares void mainImage(out vec4 fragColor, in vec2 fragCoord) "
                         "and accepts no other");
    }

    bool has_macro(std::string_view words) const {
        return std::ranges::any_of(macros_,
                                   [&](std::string_view name) { return words.find(name) != words.npos; });
    }

    /// Checks `textureOffset(iChannel0, uv, ivec2(9, 0))`.
    void offset() {
        int depth = 0;
        for (long i = 1; !peek(i).text.empty() && !peek(i).is(";"); ++i) {
            depth += peek(i).is("(") ? 1 : peek(i).is(")") ? -1 : 0;
            if (depth == 0)
                return;
            if (depth != 1 || !peek(i).text.starts_with("ivec") || !peek(i + 1).is("("))
                continue;
            for (long k = i + 2; !peek(k).text.empty() && !peek(k).is(")"); ++k) {
                if (!is_whole_number(peek(k)) || peek(k).text.size() > 6)
                    continue;
                const int sign = peek(k - 1).is("-") ? -1 : 1;
                const int value = sign * std::stoi(std::string(peek(k).text));
                if (value < k_least_offset || value > k_largest_offset)
                    say(peek(k), fmt::format("{}: offsets go from {} to {} on the site", value,
                                             k_least_offset, k_largest_offset));
            }
        }
    }

    /// Returns whether a parameter or variable hides the uniform.
    bool is_local() {
        if (is_word(-1) && !peek(-1).is("return") && !peek(-1).is("else"))
            hidden_.insert(peek(0).text);
        return hidden_.contains(peek(0).text);
    }

    void reserved() {
        const Token& token = peek(0);
        // A macro of that name is not checked; each name is reported once.
        if (!is_one_of(token.text, k_es_reserved) || macros_.contains(token.text) ||
            !reported_.insert(token.text).second)
            return;
        say(token, fmt::format("{}: a reserved word in GLSL ES 3.00; choose another name", token.text));
    }

    void missing_function(const Token& called) {
        const std::string_view instead = instead_of(called.text);
        if (!instead.empty() && !defined_.contains(called.text))
            say(called, fmt::format("{}: not in GLSL ES 3.00; write {}", called.text, instead));
    }

    void calls() {
        const Token& token = peek(0);
        if (!peek(1).is("("))
            return;
        missing_function(token);
        const BuiltinFunction* const builtin = find_builtin(token.text);
        if (braces_ == 0 && is_word(-1) && builtin && builtin->in_es() &&
            !is_one_of(token.text, k_may_be_defined_again))
            say(token,
                fmt::format("{}: GLSL ES 3.00 forbids redefining a built-in function; choose another name",
                            token.text));
    }

    /// Checks `float x = 1;` and, outside functions, values that are not constant.
    void declaration() {
        const std::string_view type = peek(0).text;
        if (!value_type(type) || !is_word(1) || !peek(2).is("="))
            return;
        long value = 3;
        const bool sign = peek(value).is("-");
        value += sign ? 1 : 0;
        if (is_float_type(type) && is_whole_number(peek(value)) &&
            (peek(value + 1).is(";") || peek(value + 1).is(",")))
            say(peek(value),
                fmt::format("{} {} = {}{}: GLSL ES does not convert int implicitly; write {}{}", type,
                            peek(1).text, sign ? "-" : "", peek(value).text, sign ? "-" : "",
                            type == "float" ? fmt::format("{}.0", peek(value).text)
                                            : fmt::format("{}({})", type, peek(value).text)));
        if (braces_ == 0 && !peek(-1).is("const") && !in_parentheses())
            global_value();
    }

    bool in_parentheses() const { return peek(-1).is("(") || peek(-1).is(",") || peek(-1).is("in"); }

    /// Checks uniforms only: only a compiler can decide whether other names are constant.
    void global_value() {
        for (long i = 3; !peek(i).text.empty() && !peek(i).is(";"); ++i) {
            const Token& part = peek(i);
            if (!is_on_site(part.text) || defined_.contains(part.text))
                continue;
            say(part, fmt::format("{}: outside functions GLSL ES allows only constant values; set {} in "
                                  "mainImage, or make it a #define",
                                  part.text, peek(1).text));
            return;
        }
    }

    const text::MappedText& text_;
    std::vector<Token> tokens_;
    Preprocessed read_;
    bool common_;
    size_t at_ = 0;
    int braces_ = 0;
    bool in_function_ = false; ///< the last brace at depth 0 opened a function body
    /// macros that open or close more braces than the reverse, with the difference
    std::unordered_map<std::string_view, int> opens_;
    std::unordered_set<std::string_view> defined_; ///< macros and functions
    std::unordered_set<std::string_view> macros_;
    std::unordered_set<std::string_view> reported_;
    std::unordered_set<std::string_view> hidden_;
    std::vector<std::pair<size_t, Diagnostic>> found_; ///< with the offset of each
};

/// Finds `condition ? a : b` with arrays or structures, which browsers refuse (GLSL ES 3.00, section 5.7).
class Conditionals {
public:
    explicit Conditionals(const ParsedText& text)
        : text_(text), tree_(text.tree()), facts_(find_facts(text)), shapes_(text) {}

    std::vector<Diagnostic> run() {
        std::vector<Diagnostic> found;
        for (NodeId id = 1; id < tree_.nodes.size(); ++id) {
            if (tree_[id].kind != NodeKind::conditional)
                continue;
            const Shape::Kind kind = kind_of(id);
            const bool array = kind == Shape::Kind::array;
            if (SourceLocation where = text_.spelled(tree_[id].word);
                !where.file.empty() && (array || kind == Shape::Kind::structure))
                found.push_back(
                    {std::move(where), Severity::warning,
                     fmt::format("? : of {}: the site refuses it; {}", array ? "arrays" : "structures",
                                 array ? "choose between elements, or write an if"
                                       : "choose between members, or write an if")});
        }
        return found;
    }

private:
    Shape::Kind kind_of(NodeId id, int depth = 0) {
        constexpr int k_deepest = 100;
        if (depth > k_deepest)
            return Shape::Kind::unknown;
        switch (tree_[id].kind) {
        case NodeKind::parenthesis: return kind_of(tree_.child(id, 0), depth + 1);
        case NodeKind::conditional: {
            const Shape::Kind yes = kind_of(tree_.child(id, 1), depth + 1);
            return yes != Shape::Kind::unknown ? yes : kind_of(tree_.child(id, 2), depth + 1);
        }
        case NodeKind::name:
        case NodeKind::index:
        case NodeKind::member: {
            const Shape* const whole = shape_of(base_of(tree_, id));
            const Shape* const part = !whole                             ? nullptr
                                      : tree_[id].kind == NodeKind::name ? whole
                                                                         : shapes_.part_of(*whole, id).shape;
            return part ? part->kind : Shape::Kind::unknown;
        }
        case NodeKind::call: return kind_of_call(id);
        default: return Shape::Kind::unknown;
        }
    }

    Shape::Kind kind_of_call(NodeId call) {
        const std::string_view name = called_name(text_, call);
        if (name.empty())
            return tree_[tree_.child(call, 0)].kind == NodeKind::index ? Shape::Kind::array
                                                                       : Shape::Kind::unknown;
        if (facts_.structures.contains(name))
            return Shape::Kind::structure;
        const FunctionFacts* const function = facts_.function(name);
        return function && !function->definitions.empty()
                   ? shapes_.of(tree_.child(function->definitions.front(), 0), k_no_node).kind
                   : Shape::Kind::unknown;
    }

    /// Returns the shape of the last variable of that name that is declared before it, in its function or
    /// globally.
    const Shape* shape_of(NodeId name) {
        const NodeId function = tree_.around(name, NodeKind::function);
        const Shape* shape = nullptr;
        bool local = false;
        for (NodeId id = 1; id < tree_.nodes.size(); ++id) {
            const bool parameter = tree_[id].kind == NodeKind::parameter;
            if ((tree_[id].kind != NodeKind::declarator && !parameter) ||
                text_.word_of(id) != text_.word_of(name) || tree_[id].begin > tree_[name].begin)
                continue;
            const NodeId where = tree_.around(id, NodeKind::function);
            if ((where != function && where != k_no_node) || (local && where == k_no_node))
                continue;
            local = where != k_no_node;
            const NodeId type = tree_.child(parameter ? id : tree_[id].parent, 0);
            shape = &shapes_.of(type, parameter ? k_no_node : id);
        }
        return shape;
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    TreeFacts facts_;
    Shapes shapes_;
};

/// Adds those of a pass, once: Common is part of several passes.
void add_conditionals(const scene::Scene& scene, const scene::Pass& pass, std::vector<Diagnostic>& all) {
    text::MappedText whole = scene.common;
    whole.append(pass.text);
    const auto text = ParsedText::read(std::move(whole), k_site_macros, false);
    if (!text)
        return; // a compiler says why
    for (Diagnostic& each : Conditionals(**text).run())
        if (std::ranges::find(all, each) == all.end())
            all.push_back(std::move(each));
}

} // namespace

std::vector<Diagnostic> portability_lint(const scene::Scene& scene) {
    Linter common(scene.common, true);
    std::vector<Diagnostic> all = common.run();
    for (const scene::Pass& pass : scene.passes) {
        Linter linter(pass.text, false);
        linter.know(common);
        for (Diagnostic& diagnostic : linter.run())
            all.push_back(std::move(diagnostic));
        add_conditionals(scene, pass, all);
    }
    return all;
}

bool is_taken_by_the_site(const PassReading& reading, std::string_view message) {
    if (message.find("formal parameter lacks a name") != message.npos)
        return true;
    return std::ranges::any_of(k_may_be_defined_again, [&](std::string_view name) {
        if (!reading.defines_function(name))
            return false;
        return message.find(fmt::format("`{}(", name)) != message.npos ||
               message.find(fmt::format("`{}'", name)) != message.npos;
    });
}

} // namespace tidemark::glsl
