#include "cmd/plot/picture.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>

#include <memory>

#include "lib/text/error.h"

namespace sg::plot {
namespace {

using Surface = std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)>;
using Page = std::unique_ptr<cairo_t, void (*)(cairo_t*)>;

cairo_status_t append(void* text, const unsigned char* bytes, unsigned int count) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

cairo_surface_t* new_surface(PictureFormat format, double width, double height, std::string& text) {
  switch (format) {
    case PictureFormat::svg:
      return cairo_svg_surface_create_for_stream(append, &text, width, height);
    case PictureFormat::png:
      return cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(width),
                                        static_cast<int>(height));
    case PictureFormat::pdf:
      break;
  }
  cairo_surface_t* const surface =
      cairo_pdf_surface_create_for_stream(append, &text, width, height);
  // The same call gives the same bytes: no date of today.
  cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, "2000-01-01T00:00:00Z");
  return surface;
}

void check(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS) {
    throw text::computation_error(std::string("cannot draw: ") + cairo_status_to_string(status));
  }
}

}  // namespace

PictureFormat picture_format(const std::string& path) {
  if (path.empty() || path == "-" || path.ends_with(".svg")) return PictureFormat::svg;
  if (path.ends_with(".png")) return PictureFormat::png;
  if (path.ends_with(".pdf")) return PictureFormat::pdf;
  throw text::usage_error("a picture's name ends in .svg, .png or .pdf; not so '" + path + "'");
}

std::string picture(PictureFormat format, double width, double height,
                    const std::function<void(cairo_t*)>& draw) {
  std::string text;
  const Surface surface(new_surface(format, width, height, text), cairo_surface_destroy);
  check(cairo_surface_status(surface.get()));
  const Page page(cairo_create(surface.get()), cairo_destroy);
  cairo_set_source_rgb(page.get(), 1, 1, 1);
  cairo_paint(page.get());
  draw(page.get());
  check(cairo_status(page.get()));
  if (format == PictureFormat::png) {
    check(cairo_surface_write_to_png_stream(surface.get(), append, &text));
  }
  cairo_surface_finish(surface.get());
  check(cairo_surface_status(surface.get()));
  return text;
}

}  // namespace sg::plot
