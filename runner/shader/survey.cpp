#include "shader/survey.hpp"

#include "base/encoding.hpp"
#include "base/tokens.hpp"
#include "shader/vocabulary.hpp"

#include <algorithm>
#include <array>

namespace tidemark::glsl {
namespace {

using text::Token;
using text::TokenKind;

/// Names of interest that are not in another table.
constexpr std::string_view k_other_names[] = {"GL_ES",     "__VERSION__",  "gl_FragColor",
                                              "st_assert", "iChannel",     "iKeyboard",
                                              "main",      "gl_FragCoord", "HW_PERFORMANCE"};

std::unordered_map<std::string_view, NameUse> names_of_interest() {
    std::unordered_map<std::string_view, NameUse> names;
    for (const OldName& old : k_old_names)
        names[old.name];
    for (const scene::HostUniform& row : scene::k_host_uniforms)
        if (row.declared != scene::Declared::by_author)
            names[row.name];
    for (const auto word : k_reserved_words)
        names[word];
    for (const auto name : k_channel_names)
        names[name];
    for (const auto name : k_channel_structs)
        names[name];
    for (const auto name : k_other_names)
        names[name];
    return names;
}

/// Returns the parameter types of an entry point as in Tidemark's prototype, without `in`.
std::span<const std::string_view> plain_parameters(scene::PassKind kind) {
    static constexpr std::string_view k_image[] = {"vec4", "vec2"};
    static constexpr std::string_view k_cubemap[] = {"vec4", "vec2", "vec3", "vec3"};
    static constexpr std::string_view k_sound[] = {"int", "float"};
    switch (kind) {
    case scene::PassKind::cubemap: return k_cubemap;
    case scene::PassKind::sound: return k_sound;
    default: return k_image;
    }
}

class Surveyor {
public:
    Surveyor(const std::vector<Token>& tokens, const Preprocessed& preprocessed, scene::PassKind kind,
             std::span<const scene::Knob> knobs)
        : tokens_(tokens), preprocessed_(preprocessed), kind_(kind), entry_(entry_point(kind)) {
        result_.names = names_of_interest();
        for (const scene::Knob& knob : knobs)
            result_.names[knob.name];
        for (const auto& [name, use] : result_.names)
            shapes_[shape(name)] = true;
    }

    Survey run() {
        count_names();
        for (const MacroLine& macro : preprocessed_.macros)
            read_macro(macro);
        for (at_ = 0; at_ < code().size(); ++at_)
            read_code();
        result_.discards = result_.discards || macros_mention("discard");
        return std::move(result_);
    }

private:
    const std::vector<size_t>& code() const { return preprocessed_.code; }
    /// Returns a token of the code, relative to the current one.
    const Token& peek(long offset) const {
        static const Token k_none;
        const long i = long(at_) + offset;
        return i < 0 || size_t(i) >= code().size() ? k_none : tokens_[code()[size_t(i)]];
    }
    bool is_word(long offset) const { return peek(offset).kind == TokenKind::identifier; }

    /// Hash of length and first letter: most identifiers differ from all names of interest in it.
    static size_t shape(std::string_view name) {
        return (name.size() % 32) * 128 + ((unsigned char)(name[0]) & 127);
    }

    NameUse* find(std::string_view name) {
        if (!shapes_[shape(name)])
            return nullptr;
        const auto found = result_.names.find(name);
        return found == result_.names.end() ? nullptr : &found->second;
    }

    /// Counts macro bodies and inactive code too: a needless alias is harmless.
    void count_names() {
        bool in_layout = false;
        for (size_t i = 0; i < tokens_.size(); ++i) {
            const Token& token = tokens_[i];
            if (token.kind != TokenKind::identifier) {
                in_layout = in_layout && !token.is(")");
                continue;
            }
            in_layout = in_layout || token.is("layout");
            NameUse* const use = find(token.text);
            if (!use)
                continue;
            if (use->count++ == 0)
                use->first = i;
            const bool before_word = i + 1 < tokens_.size() && tokens_[i + 1].kind == TokenKind::identifier &&
                                     !tokens_[i + 1].first_on_line;
            const bool named_in_directive = i > 0 && tokens_[i - 1].kind == TokenKind::identifier &&
                                            (tokens_[i - 1].is("define") || tokens_[i - 1].is("ifdef"));
            if (in_layout || (before_word && !named_in_directive))
                use->qualifier = true;
        }
    }

    void read_macro(const MacroLine& macro) {
        if (macro.undefines)
            return;
        if (NameUse* const use = find(macro.name))
            use->macro = true;
        result_.entry_is_macro = result_.entry_is_macro || macro.name == entry_;
        result_.main_is_macro = result_.main_is_macro || macro.name == "main";
        for (size_t i = macro.body; i < macro.end; ++i)
            result_.entry_in_macro = result_.entry_in_macro || tokens_[i].is(entry_);
    }

    void read_code() {
        const Token& token = peek(0);
        if (token.is("{"))
            ++depth_;
        else if (token.is("}"))
            depth_ = std::max(0, depth_ - 1);
        else if (token.is("("))
            ++parentheses_;
        else if (token.is(")"))
            parentheses_ = std::max(0, parentheses_ - 1);
        if (token.kind != TokenKind::identifier)
            return;
        if (token.is("uniform"))
            read_uniform();
        else if (token.is("out") && depth_ == 0 && !peek(-1).is("(") && !peek(-1).is(","))
            read_output();
        else if (token.is("discard"))
            result_.discards = true;
        else if (is_word(-1) && peek(1).is("("))
            read_function();
        else if (depth_ == 0 && parentheses_ == 0 && value_type(peek(-1).text))
            read_variable();
    }

    void read_variable() {
        if (NameUse* const use = find(peek(0).text))
            use->variable = true;
    }

    /// Handles an identifier between another one and a parenthesis: in GLSL that declares a function.
    void read_function() {
        const Token& name = peek(0);
        if (peek(-1).is("return") || peek(-1).is("else") || peek(-1).is("case"))
            return;
        if (NameUse* const use = find(name.text))
            use->function = true;
        if (name.is("main") && peek(-1).is("void") && !result_.main_is_macro && has_body())
            result_.mains.push_back(code()[at_]);
        if (!name.is(entry_))
            return;
        if (has_body())
            result_.entries.push_back(code()[at_]);
        read_entry();
    }

    /// Returns whether `{` follows the parameters.
    bool has_body() const {
        long i = 1;
        do {
            ++i;
        } while (!ends_parameters(peek(i)));
        return peek(i).is(")") && peek(i + 1).is("{");
    }

    /// Parameters have no parentheses; also stops in incomplete text.
    static bool ends_parameters(const Token& token) {
        return token.text.empty() || token.is(")") || token.is("(") || token.is("{") || token.is(";");
    }

    void read_entry() {
        std::vector<std::string_view> types;
        bool plain = peek(-1).is(kind_ == scene::PassKind::sound ? "vec2" : "void");
        long i = 2;
        for (; !ends_parameters(peek(i)); ++i) {
            if (peek(i).is(",") || peek(i).is("in"))
                continue;
            if (types.empty() && (peek(i).is("out") || peek(i).is("inout"))) {
                result_.entry_reads_colour = peek(i).is("inout");
                continue;
            }
            types.push_back(peek(i).text);
            if (peek(i + 1).kind == TokenKind::identifier) // the parameter's name
                ++i;
            plain = plain && (peek(i + 1).is(",") || peek(i + 1).is(")"));
        }
        result_.entry_takes_one = types.size() == 1 && types[0].starts_with("vec");
        const auto wanted = plain_parameters(kind_);
        if (kind_ == scene::PassKind::sound && types.size() == 1)
            result_.sound_takes_time_alone = types[0] == "float";
        else
            plain = plain && std::equal(types.begin(), types.end(), wanted.begin(), wanted.end());
        result_.entry_is_plain = plain;
    }

    bool macros_mention(std::string_view name) const {
        for (const MacroLine& macro : preprocessed_.macros)
            for (size_t i = macro.hash + 2; i < macro.end; ++i)
                if (tokens_[i].is(name))
                    return true;
        return false;
    }

    void read_output() {
        const long type = is_precision(peek(1).text) ? 2 : 1;
        if (result_.own_output.empty() && is_word(type) && is_word(type + 1) && peek(type + 2).is(";")) {
            result_.own_output_type = peek(type).text;
            result_.own_output = peek(type + 1).text;
        }
    }

    void read_uniform() {
        const size_t first = at_;
        UniformDeclaration declaration;
        declaration.begin = peek(0).begin;
        declaration.activity = preprocessed_.activity[code()[at_]];
        ++at_;
        while (is_precision(peek(0).text))
            ++at_;
        const std::string_view type = peek(0).text;
        bool simple = is_word(0);
        ++at_;
        while (simple && is_word(0) && !peek(0).is("uniform")) {
            OwnUniform own{peek(0).text, type, false};
            ++at_;
            int length = 0;
            simple = read_length(length) && !peek(0).is("=");
            own.same_as_site = is_same_as_site(own, length);
            declaration.names.push_back(own);
            if (!peek(0).is(","))
                break;
            ++at_;
        }
        declaration.end = peek(0).end();
        const bool whole = simple && peek(0).is(";");
        const bool layout = first > 0 && tokens_[code()[first - 1]].is(")");
        declaration.replaced = whole && !layout && can_replace(declaration, code()[first]);
        result_.uniforms.push_back(std::move(declaration));
        --at_;
    }

    /// Returns whether Tidemark's declaration is equal, and needed because the author's comes too late or may
    /// be inactive.
    bool can_replace(const UniformDeclaration& declaration, size_t token) const {
        const auto wanted = uniforms_of_wrapper(kind_);
        bool needed = declaration.activity == Activity::unknown;
        for (const OwnUniform& own : declaration.names) {
            if (!own.same_as_site)
                return false;
            needed = needed || own.name == "iGlobalTime" || result_.names.at(own.name).first < token ||
                     std::find(wanted.begin(), wanted.end(), own.name) != wanted.end();
        }
        return needed;
    }

    /// Reads `[4]`; returns false for any other length.
    bool read_length(int& length) {
        if (!peek(0).is("["))
            return true;
        const auto number = number_from<int>(peek(1).text);
        if (!number || !peek(2).is("]"))
            return false;
        length = *number;
        at_ += 3;
        return true;
    }

    static bool is_same_as_site(const OwnUniform& own, int length) {
        if (own.name == "iGlobalTime")
            return own.type == "float" && length == 0;
        const scene::HostUniform* row = scene::find_host_uniform(own.name);
        return row && row->declared == scene::Declared::by_site && row->type == own.type &&
               row->length == length;
    }

    const std::vector<Token>& tokens_;
    const Preprocessed& preprocessed_;
    scene::PassKind kind_;
    std::string_view entry_;
    std::array<bool, 32 * 128> shapes_{};
    size_t at_ = 0;
    int depth_ = 0; ///< of braces
    int parentheses_ = 0;
    Survey result_;
};

} // namespace

bool Survey::keeps_uniform(std::string_view name) const {
    return std::any_of(uniforms.begin(), uniforms.end(), [&](const UniformDeclaration& declaration) {
        return !declaration.replaced && std::any_of(declaration.names.begin(), declaration.names.end(),
                                                    [&](const OwnUniform& own) { return own.name == name; });
    });
}

bool Survey::uses(std::string_view name) const {
    const auto found = names.find(name);
    return found != names.end() && found->second.count > 0;
}

bool Survey::defines(std::string_view name) const {
    const auto found = names.find(name);
    return found != names.end() && found->second.defined();
}

std::span<const std::string_view> uniforms_of_wrapper(scene::PassKind kind) {
    static constexpr std::string_view k_cubemap[] = {"iResolution"};
    static constexpr std::string_view k_sound[] = {"iTimeOffset", "iSampleRate", "iSampleOffset"};
    switch (kind) {
    case scene::PassKind::cubemap: return k_cubemap;
    case scene::PassKind::sound: return k_sound;
    default: return {};
    }
}

std::string_view entry_point(scene::PassKind kind) {
    switch (kind) {
    case scene::PassKind::sound: return "mainSound";
    case scene::PassKind::cubemap: return "mainCubemap";
    case scene::PassKind::hit: return "mainHit";
    default: return "mainImage";
    }
}

Survey survey(const std::vector<Token>& tokens, const Preprocessed& preprocessed, scene::PassKind kind,
              std::span<const scene::Knob> knobs) {
    return Surveyor(tokens, preprocessed, kind, knobs).run();
}

std::optional<scene::Scene> hit_scene(const scene::Scene& scene) {
    const std::string_view entry = entry_point(scene::PassKind::hit);
    const auto mentions = [&](const text::MappedText& text) {
        return std::ranges::any_of(text::tokenize(text.text()),
                                   [&](const text::Token& token) { return token.is(entry); });
    };
    if (!mentions(scene.image().text) && !mentions(scene.common))
        return std::nullopt;
    scene::Scene asked = scene;
    asked.passes[scene.image_index()].kind = scene::PassKind::hit;
    return asked;
}

} // namespace tidemark::glsl
