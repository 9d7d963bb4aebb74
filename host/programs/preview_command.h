// `mars preview` and `mars play`: films before they are rendered, and after.
#pragma once

namespace CLI {
class App;
}

namespace mars::host {

void add_preview(CLI::App& app);
void add_play(CLI::App& app);

}  // namespace mars::host
