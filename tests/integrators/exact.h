// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "../support/drives.h"
#include "cases.h"

#include <myolines/oscillator/oscillator_system.h>

#include <boost/math/special_functions/jacobi_elliptic.hpp>

#include <complex>

namespace myolines::testing
{
  /// A problem with its closed form.
  struct Problem
  {
    std::string                     name;
    OscillatorParameters            parameters;
    std::function<Motion(double t)> exact;
  };

  /// u'' + c u' + u = Im(F e^(i w t)), u(0) = 1, u'(0) = 0, by undetermined coefficients.
  inline std::function<Motion(double)> linear_motion(const double c, const std::complex<double> force, const double w)
  {
    using Complex = std::complex<double>;
    const Complex i(0, 1);
    const Complex response = force / (1 - w * w + i * w * c);
    const Complex root     = (-c + std::sqrt(Complex(c * c - 4))) / 2.; // one of a conjugate pair
    // Re(h e^(root t)) with Re h = 1 - Im(response), Re(root h) = -Im(i w response)
    const double  re = 1 - std::imag(response);
    const double  im = (re * root.real() + std::imag(i * w * response)) / root.imag();
    const Complex h(re, im);
    return [=](const double t) {
      const Complex free = h * std::exp(root * t), driven = response * std::exp(i * w * t);
      return Motion{free.real() + driven.imag(), (root * free).real() + (i * w * driven).imag()};
    };
  }

  /// u'' + u + k3 u^3 = 0, u(0) = 1, u'(0) = 0: u = cn(W t | m), W^2 = 1 + k3, m = k3 / (2 W^2) (DLMF 22.19.6).
  inline Motion duffing(const double k3, const double t)
  {
    const double w = std::sqrt(1 + k3), modulus = std::sqrt(k3 / 2) / w;
    double       cn, dn;
    const double sn = boost::math::jacobi_elliptic(modulus, w * t, &cn, &dn);
    return {cn, -w * sn * dn};
  }

  inline std::vector<Problem> problems()
  {
    std::vector<Problem> all;
    OscillatorParameters p;
    all.push_back({"autonomous", p, linear_motion(0, 0, 2)});

    p.force = sine(1, 2);
    all.push_back({"forced by sin(2 t)", p, linear_motion(0, 1, 2)});

    p         = {};
    p.damping = 0.4;
    all.push_back({"damped", p, linear_motion(0.4, 0, 2)});

    p.support = sine(1, 2); // drives by s + c s'
    all.push_back({"moving support", p, linear_motion(0.4, {1, 0.8}, 2)});

    p                 = {};
    p.cubic_stiffness = 2;
    all.push_back({"cubic spring", p, [](double t) { return duffing(2, t); }});
    return all;
  }
} // namespace myolines::testing
