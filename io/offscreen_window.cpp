// SPDX-License-Identifier: MIT
#include <batten/domains/errors.h>
#include <batten/io/offscreen_window.h>

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/glew.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>

namespace batten {
namespace {

// Mesa's platform without windows needs no server; elsewhere the default display may do. EGL has one display of a kind
// in the process, which others may use as well: it is not terminated.
EGLDisplay initialised_display() {
  const auto platform_display =
      reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
  EGLDisplay display = EGL_NO_DISPLAY;
  if (platform_display) display = platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr)) return display;
  display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
  if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr)) return display;
  return EGL_NO_DISPLAY;
}

// An OpenGL context that is current as long as this lives.
class EglContext {
public:
  EglContext() : display_(initialised_display()) {
    if (display_ == EGL_NO_DISPLAY || !create()) {
      release();
      throw IoError(
          "draw_picture: there is no OpenGL context without a display; it needs EGL (libegl1, libgl1-mesa-dri)");
    }
  }
  ~EglContext() { release(); }
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

private:
  bool create() {
    constexpr std::array<EGLint, 5> wanted = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                              EGL_NONE};
    constexpr std::array<EGLint, 7> attributes = {
        EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 2, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!eglBindAPI(EGL_OPENGL_API)) return false;
    if (!eglChooseConfig(display_, wanted.data(), &config, 1, &count) || count == 0) return false;
    context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, attributes.data());
    return context_ != EGL_NO_CONTEXT && eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_);
  }

  void release() {
    if (display_ == EGL_NO_DISPLAY) return;
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
  }

  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

// A VTK window in the current context. VTK's own initialisation asks GLEW for GLX as well and gives up without an X
// server, although by then GLEW has found every function of OpenGL.
class ContextWindow : public vtkGenericOpenGLRenderWindow {
public:
  static ContextWindow* New();

  void OpenGLInitContext() override {
    if (Initialized) return;
    ContextCreationTime.Modified();
    glewExperimental = GL_TRUE;
    const GLenum result = glewInit();
    GlewInitValid = result == GLEW_OK || result == GLEW_ERROR_NO_GLX_DISPLAY;
    if (!GlewInitValid || !GLEW_VERSION_3_2) return;
    std::array<GLfloat, 2> widths = {1, 1};
    glGetFloatv(GL_ALIASED_LINE_WIDTH_RANGE, widths.data());
    MaximumHardwareLineWidth = widths[1];
    Initialized = true;
  }

  bool is_ready() const { return Initialized; }
};

vtkStandardNewMacro(ContextWindow)

}  // namespace

struct OffscreenWindow::Parts {
  EglContext context;  // outlives the window
  vtkNew<ContextWindow> window;
  vtkNew<vtkRenderer> renderer;
};

OffscreenWindow::OffscreenWindow(int width, int height) : parts_(std::make_unique<Parts>()) {
  constexpr int samples_per_pixel = 4;
  ContextWindow* const window = parts_->window;
  window->SetOwnContext(0);
  window->SetIsCurrent(true);
  window->SetSize(width, height);
  window->SetMultiSamples(samples_per_pixel);
  window->SetFrameBlitModeToNoBlit();
  parts_->renderer->SetBackground(1, 1, 1);
  window->AddRenderer(parts_->renderer);
  window->OpenGLInit();
  if (!window->is_ready()) throw IoError("draw_picture: the OpenGL found is older than version 3.2");
}

OffscreenWindow::~OffscreenWindow() { parts_->window->Finalize(); }

vtkRenderer* OffscreenWindow::renderer() const { return parts_->renderer; }

std::vector<std::uint8_t> OffscreenWindow::render() const {
  ContextWindow* const window = parts_->window;
  window->Render();
  const std::array<int, 2> size = {window->GetSize()[0], window->GetSize()[1]};
  constexpr int front = 0, right = 0;
  vtkNew<vtkUnsignedCharArray> bytes;
  window->GetPixelData(0, 0, size[0] - 1, size[1] - 1, front, bytes, right);
  std::vector<std::uint8_t> rgb(static_cast<std::size_t>(bytes->GetNumberOfValues()));
  const auto row = static_cast<std::size_t>(3 * size[0]);
  for (std::size_t j = 0; j < static_cast<std::size_t>(size[1]); ++j) {  // VTK's rows go upwards
    const std::uint8_t* const from = bytes->GetPointer(0) + (static_cast<std::size_t>(size[1]) - 1 - j) * row;
    std::copy(from, from + row, rgb.begin() + static_cast<std::ptrdiff_t>(j * row));
  }
  return rgb;
}

}  // namespace batten
