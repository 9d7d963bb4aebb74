// Small FBX and COLLADA files.
#pragma once

#include <string>

namespace mars::test {

// With a time of FBX for one second.
inline std::string fbx(int up_axis, const std::string& objects, const std::string& connections) {
  const std::string axes = up_axis == 1 ? R"(
    P: "UpAxis", "int", "Integer", "",1
    P: "UpAxisSign", "int", "Integer", "",1
    P: "FrontAxis", "int", "Integer", "",2
    P: "FrontAxisSign", "int", "Integer", "",1)"
                                        : R"(
    P: "UpAxis", "int", "Integer", "",2
    P: "UpAxisSign", "int", "Integer", "",1
    P: "FrontAxis", "int", "Integer", "",1
    P: "FrontAxisSign", "int", "Integer", "",-1)";
  return R"(; FBX 7.4.0 project file
FBXHeaderExtension:  {
  FBXHeaderVersion: 1003
  FBXVersion: 7400
}
GlobalSettings:  {
  Version: 1000
  Properties70:  {)" +
         axes + R"(
    P: "CoordAxis", "int", "Integer", "",0
    P: "CoordAxisSign", "int", "Integer", "",1
    P: "UnitScaleFactor", "double", "Number", "",1
    P: "TimeMode", "enum", "", "",6
  }
}
Objects:  {
  AnimationStack: 900, "AnimStack::Turn", "" {
    Properties70:  {
      P: "LocalStart", "KTime", "Time", "",0
      P: "LocalStop", "KTime", "Time", "",46186158000
    }
  }
  AnimationLayer: 901, "AnimLayer::Base", "" {
  }
)" + objects +
         R"(}
Connections:  {
  C: "OO",901,900
)" + connections +
         "}\n";
}

// Turns the model `model` about z by 0 to 90 degrees in a second; its own curves have numbers from `id` on.
inline std::string fbx_turn(int id) {
  std::string text = "  AnimationCurveNode: " + std::to_string(id) +
                     ", \"AnimCurveNode::R\", \"\" {\n    Properties70:  {\n      P: \"d|X\", \"Number\", \"\", "
                     "\"A\",0\n      P: \"d|Y\", \"Number\", \"\", \"A\",0\n      P: \"d|Z\", \"Number\", \"\", "
                     "\"A\",0\n    }\n  }\n";
  return text + "  AnimationCurve: " + std::to_string(id + 1) + R"(, "AnimCurve::", "" {
    Default: 0
    KeyVer: 4008
    KeyTime: *2 {
      a: 0,46186158000
    }
    KeyValueFloat: *2 {
      a: 0,90
    }
    KeyAttrFlags: *1 {
      a: 1032
    }
    KeyAttrDataFloat: *4 {
      a: 0,0,0,0
    }
    KeyAttrRefCount: *1 {
      a: 2
    }
  }
)";
}

inline std::string fbx_turn_connections(int id, int model) {
  const std::string curves = std::to_string(id), curve = std::to_string(id + 1);
  return "  C: \"OO\"," + curves + ",901\n  C: \"OP\"," + curves + "," + std::to_string(model) +
         ", \"Lcl Rotation\"\n  C: \"OP\"," + curve + "," + curves + ", \"d|Z\"\n";
}

// A motion without a figure: hips a metre up, a leg that hangs from them turned by 180 degrees before its own turn, and
// a foot, which are half a metre apart; the leg turns by 90 degrees in a second.
inline std::string fbx_motion() {
  const auto bone = [](int id, const char* name, const char* place, const char* before) {
    return "  Model: " + std::to_string(id) + ", \"Model::" + name +
           "\", \"LimbNode\" {\n    Version: 232\n    Properties70:  {\n      P: \"PreRotation\", \"Vector3D\", "
           "\"Vector\", \"\"," +
           before +
           "\n      P: \"RotationActive\", \"bool\", \"\", \"\",1\n      P: \"Lcl Translation\", \"Lcl Translation\", "
           "\"\", \"A\"," +
           place + "\n    }\n  }\n";
  };
  return fbx(1,
             bone(100, "Hips", "0,100,0", "0,0,0") + bone(101, "Leg", "10,0,0", "0,0,180") +
                 bone(102, "Foot", "0,50,0", "0,0,0") + fbx_turn(910),
             "  C: \"OO\",100,0\n  C: \"OO\",101,100\n  C: \"OO\",102,101\n" + fbx_turn_connections(910, 101));
}

// A triangle, z upward, which turns about the point 0 0 20 and about z by 90 degrees in a second.
inline std::string fbx_pivot() {
  return fbx(2,
             R"(  Geometry: 200, "Geometry::", "Mesh" {
    Vertices: *9 {
      a: 0,0,0,100,0,0,0,0,100
    }
    PolygonVertexIndex: *3 {
      a: 0,1,-3
    }
    GeometryVersion: 124
  }
  Model: 201, "Model::Flag", "Mesh" {
    Version: 232
    Properties70:  {
      P: "RotationPivot", "Vector3D", "Vector", "",50,0,0
      P: "RotationActive", "bool", "", "",1
    }
  }
)" + fbx_turn(910),
             "  C: \"OO\",201,0\n  C: \"OO\",200,201\n" + fbx_turn_connections(910, 201));
}

// A strip 2 wide and 20 tall in inches, z upward, whose upper half bends about y with the bone `upper` by 90 degrees in
// a second.
inline std::string dae_skin() {
  return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><created>2020-01-01T00:00:00</created><modified>2020-01-01T00:00:00</modified>
<unit name="inch" meter="0.0254"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="strip"><mesh>
<source id="places"><float_array id="places-array" count="18">0 0 0 2 0 0 0 0 10 2 0 10 0 0 20 2 0 20</float_array>
<technique_common><accessor source="#places-array" count="6" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="corners"><input semantic="POSITION" source="#places"/></vertices>
<polylist count="2"><input semantic="VERTEX" source="#corners" offset="0"/><vcount>4 4</vcount>
<p>0 1 3 2 2 3 5 4</p></polylist></mesh></geometry></library_geometries>
<library_controllers><controller id="skin"><skin source="#strip">
<bind_shape_matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</bind_shape_matrix>
<source id="names"><Name_array id="names-array" count="2">lower upper</Name_array><technique_common>
<accessor source="#names-array" count="2" stride="1"><param name="JOINT" type="name"/></accessor></technique_common></source>
<source id="binds"><float_array id="binds-array" count="32">1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1
1 0 0 0 0 1 0 0 0 0 1 -10 0 0 0 1</float_array><technique_common>
<accessor source="#binds-array" count="2" stride="16"><param name="TRANSFORM" type="float4x4"/></accessor>
</technique_common></source>
<source id="weights"><float_array id="weights-array" count="1">1</float_array><technique_common>
<accessor source="#weights-array" count="1" stride="1"><param name="WEIGHT" type="float"/></accessor>
</technique_common></source>
<joints><input semantic="JOINT" source="#names"/><input semantic="INV_BIND_MATRIX" source="#binds"/></joints>
<vertex_weights count="6"><input semantic="JOINT" source="#names" offset="0"/>
<input semantic="WEIGHT" source="#weights" offset="1"/><vcount>1 1 1 1 1 1</vcount>
<v>0 0 0 0 0 0 0 0 1 0 1 0</v></vertex_weights></skin></controller></library_controllers>
<library_animations><animation id="bend"><source id="times"><float_array id="times-array" count="2">0 1</float_array>
<technique_common><accessor source="#times-array" count="2" stride="1"><param name="TIME" type="float"/></accessor>
</technique_common></source>
<source id="angles"><float_array id="angles-array" count="2">0 90</float_array><technique_common>
<accessor source="#angles-array" count="2" stride="1"><param name="ANGLE" type="float"/></accessor></technique_common>
</source>
<source id="ways"><Name_array id="ways-array" count="2">LINEAR LINEAR</Name_array><technique_common>
<accessor source="#ways-array" count="2" stride="1"><param name="INTERPOLATION" type="name"/></accessor>
</technique_common></source>
<sampler id="sampler"><input semantic="INPUT" source="#times"/><input semantic="OUTPUT" source="#angles"/>
<input semantic="INTERPOLATION" source="#ways"/></sampler>
<channel source="#sampler" target="upper-node/turn.ANGLE"/></animation></library_animations>
<library_visual_scenes><visual_scene id="scene">
<node id="lower-node" name="lower" sid="lower" type="JOINT"><node id="upper-node" name="upper" sid="upper" type="JOINT">
<translate sid="place">0 0 10</translate><rotate sid="turn">0 1 0 0</rotate></node></node>
<node id="figure"><instance_controller url="#skin"><skeleton>#lower-node</skeleton></instance_controller></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#scene"/></scene></COLLADA>
)";
}

}  // namespace mars::test
