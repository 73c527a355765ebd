// Fuzzes an editor's input: the frames of messages, the messages, and the texts in them.
#include "editor/session.hpp"
#include "editor/workspace.hpp"
#include "fuzz.hpp"

#include <algorithm>
#include <string>

using namespace tidemark;

namespace {

/// Returns a message of a running session about a document that it holds.
std::string message(const std::string& method, lsp::Json params, bool request = true) {
    params["textDocument"]["uri"] = "file:///nowhere/fuzz.glsl";
    lsp::Json whole{{"jsonrpc", "2.0"}, {"method", method}, {"params", std::move(params)}};
    if (request)
        whole["id"] = 1;
    return whole.dump(-1, ' ', false, lsp::Json::error_handler_t::replace);
}

} // namespace

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string text(text_of(data, size));
    lsp::MessageReader reader;
    reader.feed(text);
    lsp::Session session("0");
    while (const auto cut = reader.next())
        session.receive(*cut);
    session.receive(text);
    session.receive(R"({"id": 0, "method": "initialize", "params": {}})");
    session.receive(message("textDocument/hover", lsp::Json::parse(text, nullptr, false).is_object()
                                                      ? lsp::Json::parse(text)
                                                      : lsp::Json::object()));
    session.receive(
        message("textDocument/didOpen", {{"textDocument", {{"text", text}, {"version", 1}}}}, false));
    const size_t lines = size_t(std::count(text.begin(), text.end(), '\n'));
    for (const size_t line : {size_t{0}, lines / 2, lines})
        for (const char* method :
             {"completion", "signatureHelp", "references", "documentHighlight", "prepareRename", "rename",
              "hover", "definition", "semanticTokens/full", "foldingRange", "documentSymbol"})
            session.receive(
                message(std::string("textDocument/") + method,
                        {{"position", {{"line", line}, {"character", size}}}, {"newName", "other"}}));
    for (const lsp::Symbol& symbol : lsp::outline(text))
        REQUIRE(symbol.begin <= symbol.name_begin && symbol.name_end() <= symbol.end && symbol.end <= size);
    return 0;
}
