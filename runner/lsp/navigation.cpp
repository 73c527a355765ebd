#include "lsp/navigation.hpp"

namespace tidemark::lsp {
namespace {

/// Returns the protocol's SymbolKind.
int number_of(Symbol::Kind kind) {
    switch (kind) {
    case Symbol::Kind::function: return 12;
    case Symbol::Kind::variable: return 13;
    case Symbol::Kind::constant: return 14;
    case Symbol::Kind::structure: return 23;
    case Symbol::Kind::macro: return 14;
    case Symbol::Kind::knob: return 7; // Property
    }
    return 13;
}

} // namespace

Json definitions(const Workspace& workspace, size_t offset, const Documents& documents, Encoding encoding) {
    Json found = Json::array();
    if (const auto included = included_at(workspace, offset); !included.empty()) {
        if (documents.text_of(included))
            found.push_back(
                {{"uri", documents.uri_of(included)}, {"range", Lines("", encoding).range(0, 0)}});
        return found;
    }
    const auto tokens = text::tokenize(workspace.files.front().text);
    const auto word = word_at(tokens, offset);
    for (const SourceFile& file : workspace.files) {
        const Lines lines(file.text, encoding);
        for (const Symbol& symbol : file.symbols)
            if (word && symbol.name == word->text)
                found.push_back({{"uri", documents.uri_of(file.path)},
                                 {"range", lines.range(symbol.name_begin, symbol.name_end())}});
    }
    return found;
}

Json document_symbols(const Workspace& workspace, Encoding encoding) {
    const SourceFile& file = workspace.files.front();
    const Lines lines(file.text, encoding);
    Json symbols = Json::array();
    for (const Symbol& symbol : file.symbols)
        symbols.push_back({{"name", symbol.name},
                           {"detail", symbol.signature},
                           {"kind", number_of(symbol.kind)},
                           {"range", lines.range(symbol.begin, symbol.end)},
                           {"selectionRange", lines.range(symbol.name_begin, symbol.name_end())}});
    return symbols;
}

} // namespace tidemark::lsp
