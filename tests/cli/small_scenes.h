// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

/// Small valid scenes that tests run or spoil.
inline const std::string oscillator_scene = R"(<?xml version="1.0"?>
<ParameterList name="scene">
  <ParameterList name="system">
    <Parameter name="type" type="string" value="oscillator"/>
    <Parameter name="mass" type="double" value="2"/>
    <Parameter name="cubic stiffness" type="double" value="10"/>
    <ParameterList name="force">
      <Parameter name="type" type="string" value="control points"/>
      <Parameter name="points" type="string" value="0 0; 0.3 1; 0.5 1"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="integrator">
    <Parameter name="type" type="string" value="backward euler"/>
  </ParameterList>
  <ParameterList name="time">
    <Parameter name="end" type="double" value="1"/>
    <Parameter name="step" type="double" value="0.1"/>
  </ParameterList>
</ParameterList>
)";

inline const std::string muscle_scene = R"(<?xml version="1.0"?>
<ParameterList name="scene">
  <Parameter name="title" type="string" value="one cell"/>
  <ParameterList name="system">
    <Parameter name="type" type="string" value="muscle 3d"/>
    <ParameterList name="geometry">
      <Parameter name="length" type="double" value="0.03"/>
      <Parameter name="refinement" type="int" value="0"/>
    </ParameterList>
    <ParameterList name="boundary">
      <ParameterList name="moving end">
        <Parameter name="face" type="string" value="x+"/>
        <Parameter name="type" type="string" value="strain"/>
        <ParameterList name="strain">
          <Parameter name="type" type="string" value="control points"/>
          <Parameter name="points" type="string" value="0 0; 0.02 0.01"/>
        </ParameterList>
      </ParameterList>
      <ParameterList name="fixed end">
        <Parameter name="face" type="string" value="x-"/>
        <Parameter name="type" type="string" value="fixed"/>
      </ParameterList>
    </ParameterList>
  </ParameterList>
  <ParameterList name="integrator">
    <Parameter name="type" type="string" value="backward euler"/>
  </ParameterList>
  <ParameterList name="time">
    <Parameter name="end" type="double" value="0.04"/>
    <Parameter name="step" type="double" value="0.02"/>
  </ParameterList>
  <ParameterList name="output">
    <ParameterList name="series">
      <Parameter name="markers" type="string" value="middle 0.015 0.005 0.005"/>
    </ParameterList>
  </ParameterList>
</ParameterList>
)";

/// A free oscillation, u = cos(t) with the defaults.
inline const std::string free_oscillation = R"(<ParameterList name="scene">
  <ParameterList name="system"><Parameter name="type" type="string" value="oscillator"/></ParameterList>
  <ParameterList name="integrator"><Parameter name="type" type="string" value="backward euler"/></ParameterList>
  <ParameterList name="time">
    <Parameter name="end" type="double" value="2"/>
    <Parameter name="step" type="double" value="0.05"/>
  </ParameterList>
</ParameterList>
)";

/// A linear rod of 0.5 m pulled by g(t) = 0.1 t^3: until the wave comes back, u = g(t - (L - x)/c) and the force is A sqrt(E rho) g'(t).
inline const std::string pulled_rod = R"(<ParameterList name="scene">
  <ParameterList name="system">
    <Parameter name="type" type="string" value="rod 1d"/>
    <Parameter name="length" type="double" value="0.5"/>
    <Parameter name="elements" type="int" value="4"/>
    <Parameter name="degree" type="int" value="1"/>
    <ParameterList name="material">
      <Parameter name="type" type="string" value="linear"/>
      <Parameter name="bulk modulus" type="double" value="1e6"/>
      <Parameter name="poisson ratio" type="double" value="0.499"/>
    </ParameterList>
    <ParameterList name="profile">
      <Parameter name="type" type="string" value="power"/>
      <Parameter name="amplitude" type="double" value="0.2"/>
      <Parameter name="exponent" type="int" value="3"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="integrator"><Parameter name="type" type="string" value="sdirk2"/></ParameterList>
  <ParameterList name="time">
    <Parameter name="end" type="double" value="0.3"/>
    <Parameter name="step" type="double" value="0.01"/>
  </ParameterList>
</ParameterList>
)";
