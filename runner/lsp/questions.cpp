#include "lsp/questions.hpp"

#include "lsp/colours.hpp"
#include "lsp/hover.hpp"
#include "lsp/navigation.hpp"
#include "lsp/rename.hpp"

#include <algorithm>
#include <utility>

namespace tidemark::lsp {
namespace {

Answer hover(const Question& asked) {
    const std::string text = hover_text(asked.workspace, asked.offset(), asked.documents);
    return text.empty() ? Json() : Json{{"contents", {{"kind", "markdown"}, {"value", text}}}};
}

Answer definition(const Question& asked) {
    return definitions(asked.workspace, asked.offset(), asked.documents, asked.encoding);
}

Answer symbols(const Question& asked) {
    return document_symbols(asked.workspace, asked.encoding);
}

Answer colours(const Question& asked) {
    return document_colours(asked.workspace, asked.encoding);
}

Answer presentations(const Question& asked) {
    return colour_presentations(asked.params.at("color"), asked.params.at("range"));
}

Answer prepare_rename(const Question& asked) {
    return renamed_range(asked.workspace, asked.offset(), asked.encoding);
}

Answer rename(const Question& asked) {
    const auto name = asked.params.at("newName").get<std::string>();
    return rename_knob(asked.workspace, asked.offset(), name, asked.documents, asked.encoding)
        .map_error([](const Error& error) {
            return Refusal{ErrorNumber::request_failed, error.message};
        });
}

constexpr std::pair<std::string_view, AnswerTo> k_questions[] = {
    {"textDocument/hover", hover},
    {"textDocument/definition", definition},
    {"textDocument/documentSymbol", symbols},
    {"textDocument/documentColor", colours},
    {"textDocument/colorPresentation", presentations},
    {"textDocument/prepareRename", prepare_rename},
    {"textDocument/rename", rename},
};

} // namespace

tl::unexpected<Refusal> refuse(ErrorNumber number, std::string message) {
    return tl::unexpected<Refusal>(Refusal{number, std::move(message)});
}

size_t Question::offset() const {
    return Lines(workspace.files.front().text, encoding).offset(params.at("position"));
}

AnswerTo find_question(std::string_view method) {
    const auto known = std::ranges::find(k_questions, method, &std::pair<std::string_view, AnswerTo>::first);
    return known == std::end(k_questions) ? nullptr : known->second;
}

} // namespace tidemark::lsp
