// How the help and the manual pages spell an option's value, its default and what it goes with: the same by
// every version of CLI11 (2.1 writes `NAME=DEFAULT`, 2.4 `NAME [DEFAULT]`).
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace tidemark::cli {

class HelpFormatter : public CLI::Formatter {
public:
    std::string make_option_opts(const CLI::Option* option) const override;
};

} // namespace tidemark::cli
