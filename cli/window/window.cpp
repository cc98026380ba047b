#include "window/window.h"

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>

#include <cstdlib>

#include "window/ui.h"

namespace pullfocus::cli::preview {

Ui::Ui(Session& session, const WindowOptions& options)
    : session_(session),
      now_(session.snapshot()),
      export_file_(options.export_file),
      export_shot_(options.export_shot),
      keys_file_(now_.keys_file) {}

void Ui::act(std::string verb, std::vector<std::string> arguments) {
  session_.act({std::move(verb), std::move(arguments)});
}

void Ui::hold() {
  if (!holding_) act("hold");
  holding_ = true;
}

void Ui::release_hold() {
  if (holding_) act("release");
  holding_ = false;
}

bool Ui::is_busy() const noexcept {
  return now_.playing || holding_ || now_.shown->request != now_.request || ImGui::IsAnyMouseDown();
}

void Ui::draw() {
  session_.tick(ImGui::GetTime());
  now_ = session_.snapshot();
  read_keyboard();
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float side = 350, bottom = 104, line = 44;
  constexpr ImGuiWindowFlags fixed = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                                     ImGuiWindowFlags_NoScrollWithMouse;
  const auto panel = [&](const char* name, ImVec2 at, ImVec2 extent, ImGuiWindowFlags flags, auto&& contents) {
    ImGui::SetNextWindowPos(at);
    ImGui::SetNextWindowSize(extent);
    ImGui::Begin(name, nullptr, flags);
    contents();
    ImGui::End();
  };
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2{0, 0});
  panel("picture", {0, 0}, {size.x - side, size.y - bottom - line}, fixed, [&] { draw_picture(); });
  ImGui::PopStyleVar();
  panel("settings", {size.x - side, 0}, {side, size.y - bottom - line},
        (fixed & ~ImGuiWindowFlags_NoScrollWithMouse & ~ImGuiWindowFlags_NoScrollbar), [&] { draw_controls(); });
  panel("timeline", {0, size.y - bottom - line}, {size.x, bottom}, fixed, [&] { draw_timeline(); });
  panel("status", {0, size.y - line}, {size.x, line}, fixed, [&] { draw_status(); });
  draw_help();
  draw_close_question();
}

namespace {

std::string last_glfw_error;

void note_error(int, const char* text) { last_glfw_error = text; }

struct Glfw {
  bool ready;
  Glfw() {
    glfwSetErrorCallback(note_error);
    ready = glfwInit() == GLFW_TRUE;
  }
  ~Glfw() {
    if (ready) glfwTerminate();
  }
};

std::string reason(const char* what) {
  return last_glfw_error.empty() ? what : fmt::format("{}: {}", what, last_glfw_error);
}

}  // namespace

std::string run_window(Session& session, const WindowOptions& options) {
  const Glfw glfw;
  if (!glfw.ready) return reason("no display can be opened (is DISPLAY set?)");
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 0);
  const std::string title = "pullfocus: " + session.snapshot().title;
  GLFWwindow* window = glfwCreateWindow(options.width, options.height, title.c_str(), nullptr, nullptr);
  if (window == nullptr) return reason("OpenGL 3 is not to be had on this display");
  glfwMakeContextCurrent(window);
  glfwSwapInterval(1);

  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  ImGui::StyleColorsDark();
  ImGui_ImplGlfw_InitForOpenGL(window, true);
  ImGui_ImplOpenGL3_Init("#version 130");
  session.on_change([] { glfwPostEmptyEvent(); });
  {
    Ui ui(session, options);
    int extra = 3;  // frames after an event until all has come to rest
    while (!ui.may_close()) {
      if (ui.is_busy() || extra > 0) {
        glfwPollEvents();
        --extra;
      } else {
        glfwWaitEventsTimeout(0.5);
        extra = 3;
      }
      if (glfwWindowShouldClose(window) != 0) {
        glfwSetWindowShouldClose(window, GLFW_FALSE);
        ui.ask_to_close();
        extra = 3;
      }
      ImGui_ImplOpenGL3_NewFrame();
      ImGui_ImplGlfw_NewFrame();
      ImGui::NewFrame();
      ui.draw();
      ImGui::Render();
      ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
      glfwSwapBuffers(window);
    }
    ui.release();
  }
  session.on_change({});
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  glfwDestroyWindow(window);
  return "";
}

}  // namespace pullfocus::cli::preview
