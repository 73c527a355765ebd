#include "shader/rewrite.hpp"

#include "shader/builtin_functions.hpp"
#include "shader/token_reading.hpp"
#include "shader/vocabulary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <unordered_map>
#include <unordered_set>

namespace tidemark::glsl {
namespace {

using text::Edit;
using text::Token;
using text::TokenKind;

/// Prefixes of extensions that a desktop driver, or a driver for GLSL ES, may support.
constexpr std::string_view k_desktop_extensions[] = {"GL_ARB_", "GL_EXT_", "GL_KHR_",   "GL_NV_",
                                                     "GL_AMD_", "GL_ATI_", "GL_INTEL_", "GL_MESA_"};
constexpr std::string_view k_es_extensions[] = {"GL_OES_", "GL_EXT_", "GL_KHR_"};

class Rewriter {
public:
    Rewriter(std::string_view text, const std::vector<Token>& tokens, const Preprocessed& preprocessed,
             const Survey& survey, const Dialect& dialect)
        : text_(text), tokens_(tokens), preprocessed_(preprocessed), survey_(survey), dialect_(dialect) {
        prepare_renames();
    }

    Rewriting run() {
        for (const size_t hash : preprocessed_.directives)
            directive(hash);
        for (const MacroLine& macro : preprocessed_.macros)
            macro_line(macro);
        for (size_t i = 0; i < tokens_.size(); ++i)
            token(i);
        for (const UniformDeclaration& uniform : survey_.uniforms)
            if (uniform.replaced)
                remove(uniform.begin, uniform.end);
        for (size_t nul = text_.find('\0'); nul != std::string_view::npos; nul = text_.find('\0', nul + 1))
            result_.edits.push_back({nul, nul + 1, " "}); // NUL would end the text for some drivers
        if (dialect_.main == MainPlace::author && !survey_.mains.empty())
            for (const size_t name : survey_.mains)
                rename(tokens_[name], k_author_main);
        add(separate_signs(tokens_, preprocessed_));
        add(settle_arguments(tokens_, preprocessed_));
        const PlainNames plain = name_plainly(tokens_, preprocessed_);
        add(plain.edits);
        result_.functions = plain.macros;
        if (dialect_.joins_overloads) {
            JoinedOverloads joined = join_overloads(tokens_, preprocessed_);
            result_.functions += joined.functions;
            add(joined.edits);
        }
        sort_edits();
        return std::move(result_);
    }

private:
    void remove(size_t begin, size_t end) { result_.edits.push_back({begin, end, {}}); }
    void add(const std::vector<Edit>& edits) {
        result_.edits.insert(result_.edits.end(), edits.begin(), edits.end());
    }
    void rename(const Token& token, std::string_view name) {
        result_.edits.push_back({token.begin, token.end(), std::string(name)});
    }

    void prepare_renames() {
        for (const auto word : k_reserved_words) {
            const auto found = survey_.names.find(word);
            if (found != survey_.names.end() && found->second.count > 0 && !found->second.qualifier)
                renames_.emplace(word, fmt::format("{}{}", k_renamed, word));
        }
        if (dialect_.version != Version::es_300) {
            if (survey_.uses("GL_ES"))
                renames_.emplace("GL_ES", k_es_macro);
            if (survey_.uses("__VERSION__"))
                renames_.emplace("__VERSION__", k_version_macro);
        }
        if (survey_.wants("gl_FragColor"))
            renames_.emplace("gl_FragColor", k_output);
    }

    /// Removes #version and #line, which Tidemark writes itself. Moves an #extension to the top, or drops it
    /// if no driver of that kind can support it. ShaderToy's preprocessor ignores a `;` after a #pragma,
    /// and an `#elseif` in a part that it leaves out: these are removed, too.
    void directive(size_t hash) {
        const size_t end = text::end_of_directive(tokens_, hash);
        if (hash + 1 >= end)
            return;
        const Token& keyword = tokens_[hash + 1];
        if (keyword.is("pragma") && tokens_[end - 1].is(";"))
            rename(tokens_[end - 1], " ");
        if (preprocessed_.activity[hash] == Activity::inactive)
            remove(tokens_[hash].begin, tokens_[end - 1].end());
        if (!keyword.is("version") && !keyword.is("line") && !keyword.is("extension"))
            return;
        remove(tokens_[hash].begin, tokens_[end - 1].end());
        if (keyword.is("extension") && hash + 2 < end)
            hoist(tokens_[hash + 2].text);
    }

    void hoist(std::string_view name) {
        std::span<const std::string_view> families = k_desktop_extensions;
        if (dialect_.version == Version::es_300)
            families = k_es_extensions;
        const bool known = std::any_of(families.begin(), families.end(),
                                       [&](std::string_view family) { return name.starts_with(family); });
        // `enable` instead of `require`, so that compilation continues without it
        std::string line = fmt::format("#extension {} : enable\n", name);
        auto& lines = result_.extensions;
        if (known && std::find(lines.begin(), lines.end(), line) == lines.end())
            lines.push_back(std::move(line));
    }

    /// Removes definitions of GL_ES, which Tidemark defines and drivers reject. Removes a comma after the
    /// last parameter, which ShaderToy's preprocessor ignores.
    void macro_line(const MacroLine& macro) {
        if (macro.name == "GL_ES")
            remove(tokens_[macro.hash].begin, tokens_[macro.end - 1].end());
        else if (macro.parameters && macro.body > macro.hash + 5 && tokens_[macro.body - 1].is(")") &&
                 tokens_[macro.body - 2].is(","))
            rename(tokens_[macro.body - 2], " ");
    }

    void token(size_t i) {
        const Token& token = tokens_[i];
        if (token.kind == TokenKind::punctuation) {
            // ShaderToy's preprocessor treats a stray byte, as from a no-break space, as a blank.
            if ((unsigned char)(token.text[0]) >= 0x80)
                rename(token, " ");
            return;
        }
        if (token.kind != TokenKind::identifier)
            return;
        if (!renames_.empty()) {
            const auto found = renames_.find(token.text);
            if (found != renames_.end())
                rename(token, found->second);
        }
    }

    /// Sorts edits by place, and drops those inside a removed part.
    void sort_edits() {
        auto& edits = result_.edits;
        std::stable_sort(edits.begin(), edits.end(), [](const Edit& a, const Edit& b) {
            return a.begin != b.begin ? a.begin < b.begin : a.end < b.end;
        });
        size_t kept = 0;
        size_t covered = 0;
        for (Edit& edit : edits) {
            if (kept > 0 && edit.begin < covered)
                continue;
            covered = std::max(covered, edit.end);
            if (&edits[kept] != &edit)
                edits[kept] = std::move(edit);
            ++kept;
        }
        edits.resize(kept);
    }

    std::string_view text_;
    const std::vector<Token>& tokens_;
    const Preprocessed& preprocessed_;
    const Survey& survey_;
    const Dialect& dialect_;
    std::unordered_map<std::string_view, std::string> renames_;
    Rewriting result_;
};

} // namespace

Rewriting rewrite(std::string_view text, const std::vector<Token>& tokens, const Preprocessed& preprocessed,
                  const Survey& survey, const Dialect& dialect) {
    return Rewriter(text, tokens, preprocessed, survey, dialect).run();
}

namespace {

using text::Edit;
using text::Token;

constexpr std::string_view k_plain_name = "tidemark_plain_";

class ArgumentSettler {
public:
    ArgumentSettler(const std::vector<Token>& tokens, const Preprocessed& preprocessed)
        : tokens_(tokens), preprocessed_(preprocessed) {
        for (const MacroLine& macro : preprocessed.macros)
            if (macro.parameters)
                macros_.insert(macro.name);
    }

    std::vector<Edit> run() {
        for (size_t i = 0; !macros_.empty() && i < tokens_.size();) {
            if (tokens_[i].first_on_line && tokens_[i].is("#")) {
                const size_t end = text::end_of_directive(tokens_, i);
                if (depth_ > 0)
                    directive(i, end);
                i = end;
            } else {
                token(i++);
            }
        }
        return std::move(edits_);
    }

private:
    void directive(size_t hash, size_t end) {
        const std::string_view keyword = hash + 1 < end ? tokens_[hash + 1].text : std::string_view{};
        if (keyword.starts_with("if"))
            ++groups_;
        else if (keyword == "endif")
            --groups_;
        else if (keyword != "else" && keyword != "elif")
            give_up();
        call_.push_back({tokens_[hash].begin, tokens_[end - 1].end(), {}});
    }

    void token(size_t i) {
        const Token& token = tokens_[i];
        if (preprocessed_.activity[i] == Activity::inactive) {
            if (depth_ > 0)
                call_.push_back({token.begin, token.end(), {}});
        } else if (depth_ == 0) {
            if (token.is("(") && i > 0 && macros_.contains(tokens_[i - 1].text))
                begin_call();
        } else if (preprocessed_.activity[i] == Activity::unknown && groups_ > 0) {
            give_up();
        } else if (token.is("(")) {
            ++depth_;
        } else if (token.is(")") && --depth_ == 0 && groups_ == 0) {
            edits_.insert(edits_.end(), call_.begin(), call_.end());
        }
    }

    void begin_call() {
        depth_ = 1;
        groups_ = 0;
        call_.clear();
    }

    void give_up() { depth_ = 0; }

    const std::vector<Token>& tokens_;
    const Preprocessed& preprocessed_;
    std::unordered_set<std::string_view> macros_; ///< macros with arguments
    int depth_ = 0;                               ///< of parentheses in the outermost call
    int groups_ = 0;                              ///< open #if in that call
    std::vector<Edit> call_;
    std::vector<Edit> edits_;
};

/// Returns the uses of macros with arguments before a `)`, up to the last directive.
std::vector<size_t> plain_uses(const std::vector<Token>& tokens, const Preprocessed& preprocessed) {
    std::unordered_set<std::string_view> macros;
    for (const MacroLine& macro : preprocessed.macros)
        if (macro.parameters)
            macros.insert(macro.name);
    const auto& code = preprocessed.code;
    std::vector<size_t> uses, settled;
    for (size_t i = 0; !macros.empty() && i + 1 < code.size(); ++i) {
        if (macros.contains(tokens[code[i]].text) && tokens[code[i + 1]].is(")"))
            uses.push_back(code[i]);
        if (code[i + 1] == code[i] + 1 || uses.empty())
            continue;
        settled.insert(settled.end(), uses.begin(), uses.end()); // a directive separates these tokens
        uses.clear();
    }
    return settled;
}

} // namespace

PlainNames name_plainly(const std::vector<Token>& tokens, const Preprocessed& preprocessed) {
    PlainNames names;
    std::unordered_set<std::string_view> known;
    for (const size_t use : plain_uses(tokens, preprocessed)) {
        const Token& token = tokens[use];
        names.edits.push_back({token.begin, token.end(), fmt::format("{}{}", k_plain_name, token.text)});
        if (known.insert(token.text).second)
            names.macros += fmt::format("#define {}{} {}\n", k_plain_name, token.text, token.text);
    }
    return names;
}

std::vector<Edit> settle_arguments(const std::vector<Token>& tokens, const Preprocessed& preprocessed) {
    return ArgumentSettler(tokens, preprocessed).run();
}

namespace {

using text::Edit;
using text::Token;

bool is_sign(const Token& token) {
    return token.is("+") || token.is("-");
}

class Spacer {
public:
    Spacer(const std::vector<Token>& tokens, const Preprocessed& preprocessed)
        : tokens_(tokens), preprocessed_(preprocessed) {}

    std::vector<Edit> run() {
        for (const MacroLine& macro : preprocessed_.macros)
            if (!macro.undefines && macro.body < macro.end)
                note(macro);
        if (functions_.empty() && trailing_.empty())
            return {};
        for (size_t i = 1; i < tokens_.size(); ++i)
            if (tokens_[i].glued && may_meet(i))
                edits_.push_back({tokens_[i].begin, tokens_[i].begin, " "});
        for (const MacroLine& macro : preprocessed_.macros)
            if (macro.parameters)
                space_parameters(macro);
        return std::move(edits_);
    }

private:
    void note(const MacroLine& macro) {
        if (macro.parameters)
            functions_.insert(macro.name);
        else if (is_sign(tokens_[macro.end - 1]) && macro.end > macro.body + 1)
            trailing_[macro.name] = tokens_[macro.end - 1].text;
    }

    /// The replacement of a macro with parameters may begin with a sign, its own or an argument's.
    bool may_meet(size_t i) const {
        const Token& before = tokens_[i - 1];
        if (is_sign(before))
            return functions_.contains(tokens_[i].text);
        const auto ending = is_sign(tokens_[i]) ? trailing_.find(before.text) : trailing_.end();
        return ending != trailing_.end() && ending->second == tokens_[i].text;
    }

    void space_parameters(const MacroLine& macro) {
        std::unordered_set<std::string_view> parameters;
        for (size_t i = macro.hash + 3; i < macro.body; ++i)
            parameters.insert(tokens_[i].text);
        for (size_t i = macro.body + 1; i < macro.end; ++i)
            if (tokens_[i].glued && is_sign(tokens_[i - 1]) && parameters.contains(tokens_[i].text))
                edits_.push_back({tokens_[i].begin, tokens_[i].begin, " "});
    }

    const std::vector<Token>& tokens_;
    const Preprocessed& preprocessed_;
    std::unordered_set<std::string_view> functions_;                  ///< macros with parameters
    std::unordered_map<std::string_view, std::string_view> trailing_; ///< macros that end in a sign
    std::vector<Edit> edits_;
};

} // namespace

std::vector<Edit> separate_signs(const std::vector<Token>& tokens, const Preprocessed& preprocessed) {
    return Spacer(tokens, preprocessed).run();
}

namespace {

using text::Token;

/// Returns the built-in function that `join_overloads` handles; nullptr if none. Functions that take constant
/// expressions are left out, because a generated function cannot pass them on.
const BuiltinFunction* joined(std::string_view name) {
    const BuiltinFunction* const function = find_builtin(name);
    return function && function->in_es() && !takes_constants(*function) ? function : nullptr;
}

/// Returns `TYPE st_NAME(TYPE a, …) { return NAME(a, …); }` and adds its parameter types to `known`; empty if
/// they are in `known` already.
std::string forwarder(std::string_view name, const BuiltinOverload& overload, std::set<std::string>& known) {
    std::string types, parameters, arguments;
    for (const BuiltinParameter& parameter : overload.parameters) {
        const char letter = char('a' + (&parameter - overload.parameters.data()));
        const std::string_view comma = types.empty() ? "" : ", ";
        types += fmt::format("{} ", parameter.type);
        parameters +=
            fmt::format("{}{}{} {}", comma, parameter.written ? "out " : "", parameter.type, letter);
        arguments += fmt::format("{}{}", comma, letter);
    }
    if (!known.insert(types).second)
        return {};
    return fmt::format("{0} {1}{2}({3}) {{ return {2}({4}); }}\n", overload.result, k_renamed, name,
                       parameters, arguments);
}

/// Returns the parameter types of the author's functions of that name, in the format of `forwarder`.
std::set<std::string> own_signatures(const std::vector<Function>& functions, std::string_view name) {
    std::set<std::string> signatures;
    for (const Function& function : functions) {
        std::string types;
        for (const Parameter& parameter : function.parameters)
            types += fmt::format("{}{} ", parameter.type, parameter.array ? "[]" : "");
        if (function.name == name)
            signatures.insert(types);
    }
    return signatures;
}

} // namespace

bool overloads_builtins(const std::vector<Token>& tokens, const Preprocessed& preprocessed) {
    const auto functions = find_functions(tokens, preprocessed);
    return std::any_of(functions.begin(), functions.end(),
                       [](const Function& each) { return joined(each.name) != nullptr; });
}

JoinedOverloads join_overloads(const std::vector<Token>& tokens, const Preprocessed& preprocessed) {
    JoinedOverloads result;
    const auto functions = find_functions(tokens, preprocessed);
    std::unordered_set<std::string_view> names;
    for (const Function& function : functions) {
        const BuiltinFunction* const builtin = joined(function.name);
        if (!builtin || !names.insert(function.name).second)
            continue;
        std::set<std::string> known = own_signatures(functions, function.name);
        for (const BuiltinOverload& overload : overloads_of(*builtin))
            result.functions += forwarder(function.name, overload, known);
    }
    for (size_t i = 0; i + 1 < tokens.size(); ++i)
        if (tokens[i + 1].is("(") && names.contains(tokens[i].text) && !(i > 0 && tokens[i - 1].is(".")))
            result.edits.push_back(
                {tokens[i].begin, tokens[i].end(), fmt::format("{}{}", k_renamed, tokens[i].text)});
    return result;
}

} // namespace tidemark::glsl
