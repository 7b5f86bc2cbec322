/// The few functions of OpenGL 1.1 that drawing blocks takes. libGL itself is there wherever YADE's window is.
#pragma once

extern "C" {
void glBegin(unsigned what);
void glEnd();
void glVertex3d(double x, double y, double z);
void glColor3d(double red, double green, double blue);
void glLineWidth(float pixels);
void glEnable(unsigned what);
void glDisable(unsigned what);
void glPolygonOffset(float slope, float units);
void glPushAttrib(unsigned bits);
void glPopAttrib();
}

constexpr unsigned GL_LINES = 1, GL_TRIANGLES = 4;
constexpr unsigned GL_LIGHTING = 0x0B50, GL_DEPTH_TEST = 0x0B71, GL_POLYGON_OFFSET_FILL = 0x8037;
constexpr unsigned GL_CURRENT_BIT = 0x1, GL_LINE_BIT = 0x4, GL_POLYGON_BIT = 0x8, GL_LIGHTING_BIT = 0x40, GL_ENABLE_BIT = 0x2000;
