// SPDX-License-Identifier: GPL-3.0-or-later
// Protocol of Chromium's developer tools over its debugging pipe: JSON messages, each ended by a zero byte.
#include "mechanism/view/browser.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "common/child.hpp"
#include "common/error.hpp"
#include "common/text.hpp"
#include "formats/page/page_blocks.hpp"

namespace tisserand::mechanism {
namespace {

using formats::Json;
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds patience{180};  // without a graphics card a large page takes time
constexpr double seconds_to_end = 10.0;

std::string browser_program() {
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
    if (is_program(name)) return name;
  throw Error(
      "pictures need Chromium, which is not installed", "picture",
      "install it (Debian: apt-get install chromium), or make a page with `mechanism view` and save a picture from it");
}

/// Temporary folder, removed with the object.
class ProfileFolder {
 public:
  ProfileFolder() : path_((fs::temp_directory_path() / "tisserand-browser-XXXXXX").string()) {
    if (::mkdtemp(path_.data()) == nullptr)
      throw Error("cannot create a temporary folder", path_, remedy_of_errno(errno));
  }
  ~ProfileFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  ProfileFolder(const ProfileFolder&) = delete;
  ProfileFolder& operator=(const ProfileFolder&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// Thrown if the browser does not answer. Its error stream says why.
struct Silence {};

class Conversation {
 public:
  explicit Conversation(int socket) : socket_(socket) {}

  /// Result of a method. `session` may be empty. Events in between are ignored.
  Json ask(const std::string& method, const Json& parameters, const std::string& session) {
    Json message{{"id", ++last_}, {"method", method}, {"params", parameters}};
    if (!session.empty()) message["sessionId"] = session;
    const std::string text = message.dump() + '\0';
    for (std::size_t at = 0; at < text.size();) {
      const ssize_t sent = ::send(socket_, text.data() + at, text.size() - at, MSG_NOSIGNAL);
      if (sent <= 0) throw Silence{};
      at += static_cast<std::size_t>(sent);
    }
    for (;;) {
      const Json answer = receive();
      if (answer.value("id", 0) != last_) continue;
      if (answer.contains("error")) return Json{{"failed", answer["error"].value("message", "")}};
      return answer.value("result", Json::object());
    }
  }

 private:
  Json receive() {
    std::size_t end = 0;
    while ((end = rest_.find('\0')) == std::string::npos) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end_ - Clock::now()).count();
      pollfd event{socket_, POLLIN, 0};
      if (left <= 0 || ::poll(&event, 1, static_cast<int>(left)) <= 0) throw Silence{};
      std::array<char, 65536> bytes{};
      const ssize_t count = ::recv(socket_, bytes.data(), bytes.size(), 0);
      if (count <= 0) throw Silence{};
      rest_.append(bytes.data(), static_cast<std::size_t>(count));
    }
    const Json message = Json::parse(rest_.substr(0, end), nullptr, false);
    rest_.erase(0, end + 1);
    return message.is_object() ? message : Json::object();
  }

  int socket_;
  int last_ = 0;
  std::string rest_;
  Clock::time_point end_ = Clock::now() + patience;
};

/// URL of a file: file:///a%20b.html. Letters, digits and - . _ ~ / stay (RFC 3986).
std::string file_url(const std::string& path) {
  std::string url = "file://";
  for (const char c : fs::absolute(path).lexically_normal().string()) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       std::string_view("-._~/").find(c) != std::string_view::npos;
    url += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return url;
}

/// Result of an evaluation: a text, or its failure.
struct Answer {
  std::string text, failure;
};

Answer evaluate(Conversation& conversation, const std::string& session, const std::string& expression) {
  const Json result = conversation.ask(
      "Runtime.evaluate", {{"expression", expression}, {"awaitPromise", true}, {"returnByValue", true}}, session);
  if (result.contains("exceptionDetails")) {
    const Json& details = result["exceptionDetails"];
    const Json exception = details.value("exception", Json::object());
    return {"", exception.value("description", details.value("text", "it failed"))};
  }
  const Json value = result.value("result", Json::object()).value("value", Json());
  return {value.is_string() ? value.get<std::string>() : value.dump(), result.value("failed", "")};
}

Answer converse(Conversation& conversation, const std::string& page, const std::string& expression) {
  const std::string target =
      conversation.ask("Target.createTarget", {{"url", "about:blank"}}, "").value("targetId", "");
  const std::string session =
      conversation.ask("Target.attachToTarget", {{"targetId", target}, {"flatten", true}}, "").value("sessionId", "");
  const Json light{{"features", Json::array({{{"name", "prefers-color-scheme"}, {"value", "light"}}})}};
  conversation.ask("Emulation.setEmulatedMedia", light, session);
  conversation.ask("Emulation.setDeviceMetricsOverride",
                   {{"width", 800}, {"height", 600}, {"deviceScaleFactor", 1}, {"mobile", false}}, session);
  const std::string url = file_url(page);
  conversation.ask("Page.navigate", {{"url", url}}, session);
  const std::string is_open = "String(location.href === " + Json(url).dump() + " && window.tisserand !== undefined)";
  while (evaluate(conversation, session, is_open).text != "true")
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  const Answer failure = evaluate(conversation, session, "tisserand.failure ?? ''");
  const Answer answer = failure.text.empty() ? evaluate(conversation, session, expression) : Answer{"", failure.text};
  conversation.ask("Browser.close", Json::object(), "");
  return answer;
}

ChildRequest browser_request(const std::string& profile, Sandbox sandbox) {
  ChildRequest request;
  // Drawn by software, so equal on every machine. No network traffic of the browser itself.
  request.words = {browser_program(),
                   "--headless",
                   "--disable-gpu",
                   "--enable-unsafe-swiftshader",
                   "--no-first-run",
                   "--disable-background-networking",
                   "--disable-component-update",
                   "--disable-sync",
                   "--disable-default-apps",
                   "--disable-extensions",
                   "--mute-audio",
                   "--hide-scrollbars",
                   "--disable-dev-shm-usage",
                   "--force-color-profile=srgb",
                   "--remote-debugging-pipe",
                   "--user-data-dir=" + profile,
                   "about:blank"};
  if (sandbox == Sandbox::off) request.words.insert(request.words.end() - 1, "--no-sandbox");
  request.seconds = seconds_to_end;
  return request;
}

}  // namespace

std::string asked_of_page(const std::string& page, const std::string& expression, Sandbox sandbox) {
  if (sandbox == Sandbox::on && ::geteuid() == 0)
    throw Error("Chromium does not run for root with its sandbox", "picture",
                "run it as another user, or give --no-sandbox if you trust the results file. Without the sandbox, only "
                "Chromium's own checks protect the files of root from the page, which is made from the results file");
  const ProfileFolder profile;
  ChildRequest request = browser_request(profile.path(), sandbox);
  Answer answer;
  bool fell_silent = false;
  request.talk = [&](int socket) {
    Conversation conversation(socket);
    try {
      answer = converse(conversation, page, expression);
    } catch (const Silence&) {
      fell_silent = true;
    }
  };
  const ChildReport report = run_child(request);
  if (fell_silent)
    throw Error(fmt::format("the browser did not answer: {}", printable_line(report.complaint, 300)), request.words[0],
                "check whether it starts in this terminal with --headless");
  if (!answer.failure.empty())
    throw Error(fmt::format("the page cannot be drawn: {}", printable_line(answer.failure, 300)), page,
                "open it in a browser to see it");
  return answer.text;
}

}  // namespace tisserand::mechanism
