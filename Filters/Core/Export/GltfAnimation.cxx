// SPDX-License-Identifier: BSD-3-Clause
#include "Export/GltfAnimation.h"

#include "Base/FractionDone.h"

#include "Base/AtomicFile.h"
#include "Base/MeshNormals.h"
#include "Base/ShapeMeasures.h"
#include "Export/Appender.h"

#include <tiny_gltf.h>

#include <cmath>
#include <cstring>
#include <ostream>
#include <utility>

namespace waft
{
namespace
{
/// Numbers of one accessor, `Width` to an element.
template <typename T>
struct Elements
{
  std::vector<T> Values;
  int Type = TINYGLTF_TYPE_SCALAR;
  std::size_t Width = 1;
};

constexpr std::size_t NumbersOfPose = 3 + 4; // a place and a quaternion

Vec3 ToYUp(const Vec3& v)
{
  return Vec3(v.x(), v.z(), -v.y());
}

Elements<float> Vectors(const std::vector<Vec3>& vectors)
{
  Elements<float> elements{ {}, TINYGLTF_TYPE_VEC3, 3 };
  for (const Vec3& vector : vectors)
  {
    const Vec3 v = ToYUp(vector);
    for (int i = 0; i < 3; ++i)
    {
      elements.Values.push_back(static_cast<float>(v[i]));
    }
  }
  return elements;
}

tinygltf::Value Extras(const std::string& name, tinygltf::Value value)
{
  return tinygltf::Value(tinygltf::Value::Object{ { name, std::move(value) } });
}

/// The factor is an amount of light; a scene's colour is what a screen is told (sRGB).
double Linear(double value)
{
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

class Writer
{
public:
  explicit Writer(double framesPerSecond) : FramesPerSecond(framesPerSecond)
  {
    this->Model.asset.version = "2.0";
    this->Model.asset.generator = "Waft";
    this->Model.asset.extras = Extras("framesPerSecond", tinygltf::Value(framesPerSecond));
    this->Model.buffers.emplace_back();
    this->Model.scenes.emplace_back();
    this->Model.defaultScene = 0;
  }

  void AddShape(const AnimatedShape& shape)
  {
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes["POSITION"] =
      this->AddAccessor(Vectors(shape.Body.Mesh.Points), TINYGLTF_TARGET_ARRAY_BUFFER);
    primitive.attributes["NORMAL"] =
      this->AddAccessor(Vectors(shape.Normals), TINYGLTF_TARGET_ARRAY_BUFFER);
    if (!shape.Body.TextureCoordinates.empty())
    {
      Elements<float> coordinates{ {}, TINYGLTF_TYPE_VEC2, 2 };
      for (const auto& uv : shape.Body.TextureCoordinates)
      {
        coordinates.Values.push_back(static_cast<float>(uv[0]));
        coordinates.Values.push_back(static_cast<float>(1.0 - uv[1])); // rows from the top
      }
      primitive.attributes["TEXCOORD_0"] =
        this->AddAccessor(coordinates, TINYGLTF_TARGET_ARRAY_BUFFER);
    }
    Elements<std::uint32_t> corners;
    for (const auto& triangle : shape.Body.Mesh.Triangles)
    {
      for (const int corner : triangle)
      {
        corners.Values.push_back(static_cast<std::uint32_t>(corner));
      }
    }
    primitive.indices = this->AddAccessor(corners, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    primitive.material = this->AddMaterial(shape);
    tinygltf::Mesh mesh;
    mesh.name = shape.Body.Name;
    mesh.primitives.push_back(primitive);
    this->Model.meshes.push_back(mesh);
  }

  void AddTimes(std::size_t frames)
  {
    Elements<float> times;
    for (std::size_t k = 0; k < frames; ++k)
    {
      times.Values.push_back(static_cast<float>(static_cast<double>(k) / this->FramesPerSecond));
    }
    this->Times = this->AddAccessor(times, 0);
    this->Model.animations.emplace_back();
    this->Model.animations[0].name = "Motion";
  }

  /// For as many poses of objects: bytes that grow are there twice.
  void Reserve(std::size_t poses)
  {
    std::vector<unsigned char>& data = this->Model.buffers[0].data;
    data.reserve(data.size() + poses * NumbersOfPose * sizeof(float));
  }

  void AddObject(const AnimatedObject& object)
  {
    tinygltf::Node node;
    const std::string& shape = this->Model.meshes[object.Shape].name;
    node.name = (shape.empty() ? "object" : shape) + "-" + std::to_string(object.ObjectId);
    node.extras = Extras("ObjectId", tinygltf::Value(object.ObjectId));
    node.mesh = static_cast<int>(object.Shape);
    const Vec3 translation = ToYUp(object.Positions[0]);
    const Vec3 axis = ToYUp(object.Orientations[0].vec());
    node.translation = { translation.x(), translation.y(), translation.z() };
    node.rotation = { axis.x(), axis.y(), axis.z(), object.Orientations[0].w() };
    const int number = static_cast<int>(this->Model.nodes.size());
    this->Model.nodes.push_back(node);
    this->Model.scenes[0].nodes.push_back(number);

    Elements<float> turns{ {}, TINYGLTF_TYPE_VEC4, 4 };
    for (const Quat& q : object.Orientations)
    {
      const Vec3 v = ToYUp(q.vec());
      for (const double x : { v.x(), v.y(), v.z(), q.w() })
      {
        turns.Values.push_back(static_cast<float>(x));
      }
    }
    this->AddChannel(number, "translation", this->AddAccessor(Vectors(object.Positions), 0));
    this->AddChannel(number, "rotation", this->AddAccessor(turns, 0));
  }

  bool Save(std::string& bytes)
  {
    bytes.clear();
    bytes.reserve(this->Model.buffers[0].data.size());
    Appender appender(bytes);
    std::ostream stream(&appender);
    tinygltf::TinyGLTF gltf;
    return gltf.WriteGltfSceneToStream(&this->Model, stream, false, true) && stream.good();
  }

private:
  int AddView(const void* bytes, std::size_t size, int target)
  {
    std::vector<unsigned char>& data = this->Model.buffers[0].data;
    data.resize((data.size() + 3) / 4 * 4, 0); // accessors begin at multiples of four
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = size;
    view.target = target;
    data.resize(data.size() + size);
    std::memcpy(data.data() + view.byteOffset, bytes, size);
    this->Model.bufferViews.push_back(view);
    return static_cast<int>(this->Model.bufferViews.size()) - 1;
  }

  template <typename T>
  int AddAccessor(const Elements<T>& elements, int target)
  {
    tinygltf::Accessor accessor;
    accessor.bufferView =
      this->AddView(elements.Values.data(), elements.Values.size() * sizeof(T), target);
    accessor.componentType = sizeof(T) == sizeof(float) && std::is_floating_point<T>::value
                               ? TINYGLTF_COMPONENT_TYPE_FLOAT
                               : TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    accessor.type = elements.Type;
    accessor.count = elements.Values.size() / elements.Width;
    for (std::size_t c = 0; c < elements.Width; ++c)
    {
      T low = elements.Values[c];
      T high = low;
      for (std::size_t i = c; i < elements.Values.size(); i += elements.Width)
      {
        low = std::min(low, elements.Values[i]);
        high = std::max(high, elements.Values[i]);
      }
      accessor.minValues.push_back(static_cast<double>(low));
      accessor.maxValues.push_back(static_cast<double>(high));
    }
    this->Model.accessors.push_back(accessor);
    return static_cast<int>(this->Model.accessors.size()) - 1;
  }

  int AddMaterial(const AnimatedShape& shape)
  {
    tinygltf::Material material;
    material.name = shape.Body.Name;
    material.doubleSided = true;
    material.pbrMetallicRoughness.metallicFactor = 0.0;
    material.pbrMetallicRoughness.roughnessFactor = 0.8;
    const bool textured = !shape.Texture.Bytes.empty() && !shape.Body.TextureCoordinates.empty();
    const auto& color = textured ? shape.Body.Tint : shape.Body.Color;
    material.pbrMetallicRoughness.baseColorFactor = { Linear(color[0]), Linear(color[1]),
                                                      Linear(color[2]), 1.0 };
    if (textured)
    {
      tinygltf::Image image;
      image.name = shape.Body.Name;
      image.mimeType = shape.Texture.MimeType;
      image.bufferView = this->AddView(shape.Texture.Bytes.data(), shape.Texture.Bytes.size(), 0);
      tinygltf::Texture texture;
      texture.source = static_cast<int>(this->Model.images.size());
      this->Model.images.push_back(image);
      material.pbrMetallicRoughness.baseColorTexture.index =
        static_cast<int>(this->Model.textures.size());
      this->Model.textures.push_back(texture);
      material.alphaMode = "MASK";
      material.alphaCutoff = 0.5;
    }
    const double opacity = Opacity(shape.Body);
    if (opacity < 1.0)
    {
      material.pbrMetallicRoughness.baseColorFactor[3] = opacity;
      material.pbrMetallicRoughness.roughnessFactor = 0.1; // a film shines
      material.alphaMode = "BLEND";
    }
    this->Model.materials.push_back(material);
    return static_cast<int>(this->Model.materials.size()) - 1;
  }

  void AddChannel(int node, const char* path, int accessor)
  {
    tinygltf::Animation& animation = this->Model.animations[0];
    tinygltf::AnimationSampler sampler;
    sampler.input = this->Times;
    sampler.output = accessor;
    sampler.interpolation = "LINEAR";
    tinygltf::AnimationChannel channel;
    channel.sampler = static_cast<int>(animation.samplers.size());
    channel.target_node = node;
    channel.target_path = path;
    animation.samplers.push_back(sampler);
    animation.channels.push_back(channel);
  }

  tinygltf::Model Model;
  double FramesPerSecond;
  int Times = -1;
};

Result Check(const std::vector<AnimatedShape>& shapes, const std::vector<AnimatedObject>& objects,
             double framesPerSecond)
{
  if (!(framesPerSecond > 0.0) || !std::isfinite(framesPerSecond))
  {
    return Result::Error("the frame rate must be positive");
  }
  for (const AnimatedShape& shape : shapes)
  {
    const std::size_t points = shape.Body.Mesh.Points.size();
    const std::string name = "shape '" + shape.Body.Name + "'";
    if (shape.Body.Mesh.Triangles.empty())
    {
      return Result::Error(name + " has no triangles");
    }
    if ((!shape.Normals.empty() && shape.Normals.size() != points) ||
        (!shape.Body.TextureCoordinates.empty() && shape.Body.TextureCoordinates.size() != points))
    {
      return Result::Error(name + ": expected a normal and a texture coordinate for each of " +
                           std::to_string(points) + " points");
    }
    for (const auto& triangle : shape.Body.Mesh.Triangles)
    {
      for (const int corner : triangle)
      {
        if (corner < 0 || corner >= static_cast<int>(points))
        {
          return Result::Error(name + ": a triangle names point " + std::to_string(corner) +
                               " of " + std::to_string(points));
        }
      }
    }
  }
  for (const AnimatedObject& object : objects)
  {
    const std::string name = "object " + std::to_string(object.ObjectId);
    if (object.Shape >= shapes.size())
    {
      return Result::Error(name + ": shape " + std::to_string(object.Shape) + " of " +
                           std::to_string(shapes.size()) + ": expected a number below");
    }
    if (object.Positions.empty() || object.Positions.size() != objects[0].Positions.size() ||
        object.Orientations.size() != object.Positions.size())
    {
      return Result::Error(name + ": its poses have another number of frames");
    }
    for (std::size_t k = 0; k < object.Positions.size(); ++k)
    {
      if (!object.Positions[k].allFinite() || !object.Orientations[k].coeffs().allFinite())
      {
        return Result::Error(name + ", frame " + std::to_string(k) + ": a number is not finite");
      }
    }
  }
  return Result::Ok();
}
} // namespace

Result GltfAnimation(const std::vector<AnimatedShape>& shapes, std::vector<AnimatedObject> objects,
                     double framesPerSecond, std::string& bytes, Monitor& monitor)
{
  WAFT_RETURN_IF_FAILED(Check(shapes, objects, framesPerSecond));
  try
  {
    Writer writer(framesPerSecond);
    for (const AnimatedShape& shape : shapes)
    {
      AnimatedShape whole = shape;
      if (whole.Normals.empty())
      {
        whole.Normals = SmoothNormals(whole.Body.Mesh);
      }
      writer.AddShape(whole);
    }
    if (!objects.empty())
    {
      writer.AddTimes(objects[0].Positions.size());
      writer.Reserve(objects.size() * objects[0].Positions.size());
    }
    for (std::size_t i = 0; i < objects.size(); ++i)
    {
      if (!monitor.Tick(FractionDone(i, objects.size()), "Writing the animation"))
      {
        return Result::Stopped();
      }
      writer.AddObject(objects[i]);
      objects[i] = AnimatedObject();
    }
    if (!writer.Save(bytes))
    {
      return Result::Error("tinygltf could not write the animation");
    }
  }
  catch (const std::exception& error)
  {
    return Result::Error(std::string("tinygltf: ") + error.what());
  }
  return Result::Ok();
}

Result WriteAnimationGlb(const std::string& path, const std::vector<AnimatedShape>& shapes,
                         std::vector<AnimatedObject> objects, double framesPerSecond,
                         Monitor& monitor)
{
  std::string bytes;
  const Result result = GltfAnimation(shapes, std::move(objects), framesPerSecond, bytes, monitor);
  return result && !result.IsStopped() ? WriteWholeFile(path, bytes) : result;
}

} // namespace waft
