// HTML report pages: escaping and templates, interactive controls, the page itself.
//
// Fills HTML templates and escapes text from scenes, studies and drivers, so that none of it acts as markup.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace tidemark::report {

/// Escapes text for content and quoted attributes, on one line: control characters become spaces.
std::string escaped(std::string_view text);

/// Escapes text for content and keeps its line breaks.
std::string escaped_lines(std::string_view text);

/// Escapes JSON for a `<script>` element, which would end at any `</script`, even inside a JSON string.
std::string in_script(std::string_view json);

struct Filling {
    std::string_view mark; ///< `{{title}}`
    std::string_view text; ///< HTML
};

/// Replaces each mark of the template once. `fillings` must be in the order of the marks; filled-in text is
/// not searched again.
std::string filled(std::string_view form, std::initializer_list<Filling> fillings);

// Interactive controls of a report page, run by page/*.js. Returns HTML, which is hidden if scripts are off.

/// Returns input fields for the largest allowed error and time.
std::string limits_form(const std::string& error_name);

/// Returns a comparison of two pictures with a divider. `reference` is a figure as HTML, shown alone if
/// scripts are off.
std::string comparison_form(const std::string& note, const std::string& reference);

// A report page: one HTML file that makes no network requests and is complete without scripts. Texts and the
// body's HTML in, the file's text out, with the style and the scripts of page/.

struct Page {
    std::string title; ///< plain text, as the next two fields are
    std::string heading;
    std::string about;
    std::string body;   ///< HTML
    std::string data{}; ///< JSON for the scripts of a diagram; empty: no diagram
};

std::string make_page(const Page& page);

/// Returns a command with a button that copies it, if scripts are on.
std::string command(const std::string& words);

/// Returns a table with its own scroll bar. `name` is its accessible name; `rows` is HTML.
std::string table(const std::string& name, const std::string& rows);

} // namespace tidemark::report
