#pragma once

#include <cstddef>

#include "sigmascape/base/lanes.h"
#include "sigmascape/radar/channels.h"
#include "sigmascape/scatter/facet.h"
#include "sigmascape/scatter/field.h"
#include "sigmascape/scatter/surface_sample.h"

namespace sigmascape::scatter {

/// What sixteen waves and the surfaces that they meet say to one another.

struct FieldPairLanes {
  VectorLanes v_re, v_im, h_re, h_im;

  [[nodiscard]] FieldPair operator[](std::size_t i) const { return {{v_re[i], v_im[i]}, {h_re[i], h_im[i]}}; }
  void set(std::size_t i, const FieldPair& pair) {
    v_re.set(i, pair.from_v.re);
    v_im.set(i, pair.from_v.im);
    h_re.set(i, pair.from_h.re);
    h_im.set(i, pair.from_h.im);
  }
};

struct ChannelLanes {
  FloatLanes vv, hh, hv, re_vvhh;

  [[nodiscard]] radar::Channels operator[](std::size_t i) const { return {vv[i], hh[i], hv[i], re_vvhh[i]}; }
  void set(std::size_t i, const radar::Channels& c) {
    vv[i] = c.vv;
    hh[i] = c.hh;
    hv[i] = c.hv;
    re_vvhh[i] = c.re_vvhh;
  }
};

/// From where waves meet which faces.
struct ArrivalLanes {
  std::size_t count = lane_count;  ///< lanes from here on may hold anything, and so may their answers
  VectorLanes to_source, normal;
  FloatLanes inverse_area_per_m2;

  [[nodiscard]] Facet face(std::size_t i) const { return {normal[i], inverse_area_per_m2[i]}; }
};

struct PassageLanes {
  FieldPairLanes fields;
  FloatLanes pdf, reverse_pdf;

  void set(std::size_t i, const Passage& passage) {
    fields.set(i, passage.fields);
    pdf[i] = passage.pdf;
    reverse_pdf[i] = passage.reverse_pdf;
  }
};

}  // namespace sigmascape::scatter
