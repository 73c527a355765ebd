// What an editor sends: the frames of messages, the messages, and the texts that they bring.
#include "editor/session.hpp"
#include "editor/workspace.hpp"
#include "fuzz.hpp"

#include <string>

using namespace tidemark;

namespace {

/// Of a running session about a document that it holds.
std::string message(const std::string& method, lsp::Json params) {
    params["textDocument"]["uri"] = "file:///nowhere/fuzz.glsl";
    return lsp::Json{{"jsonrpc", "2.0"}, {"id", 1}, {"method", method}, {"params", std::move(params)}}.dump(
        -1, ' ', false, lsp::Json::error_handler_t::replace);
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
    for (const lsp::Symbol& symbol : lsp::outline(text))
        REQUIRE(symbol.begin <= symbol.name_begin && symbol.name_end() <= symbol.end && symbol.end <= size);
    return 0;
}
