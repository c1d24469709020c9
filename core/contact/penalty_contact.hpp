#pragma once
#include <memory>

#include "core/compute/state_archive.hpp"
#include "core/contact/contact_law.hpp"
#include "core/contact/edge_contact.hpp"
#include "core/contact/motion_watch.hpp"
#include "core/contact/point_contact.hpp"

namespace polynya::contact {

/// Penalty contact of two bodies, or of a body with itself.
///
/// What is looked at: the secondary's vertices and particles against the primary's triangles, always; with `two_way`
/// the primary's vertices against the secondary's triangles as well; with `edges` crossing edges.
///
/// Stiffness is not counted twice: it belongs to vertices, in proportion to their mass, so one surface's vertices
/// together make up the whole of a contact's stiffness per area. Looked at both ways, every vertex gets half of it: the
/// sum over an area is the mean of what the two surfaces would have alone, whatever their meshes. Particles, which have
/// no triangles, keep the whole. Edges come in only where their nearer ends are not in contact (EdgeContact).
///
/// Candidates are kept until vertices may have moved by the skin relative to the other body (MotionWatch); forces
/// have the same bits as with a search in every step. The same holds for any number of threads. Once warm, evaluate
/// allocates nothing.
class PenaltyContact {
 public:
  explicit PenaltyContact(const ContactLaw& law);

  /// Call before the first evaluation, and when vertices, particles or triangles of a body are others than before.
  void set_topology(const Body& primary, const Body& secondary);

  /// Forces for the configuration given, which the last step of dt (s) led to with the velocities given; to be held
  /// over the next step, of about the same length. Positions in the last step are taken to be straight: x - dt v.
  const ContactForces& evaluate(const Body& primary, const Body& secondary, double dt);

  std::size_t searches() const { return searches_; }  ///< so far

  /// Between evaluations. What the search works with is made anew.
  void list_state(compute::StateArchive& archive);

 private:
  POLYNYA_STATE_MEMBERS_WITHOUT((forces_), law_, margin_, first_, second_, secondary_points_, primary_points_, edges_,
                                watch_, springs_, primary_triangles_, touches_, forces_, searches_, last_step_,
                                outdated_)
  void search(const Body& primary, const Body& secondary);

  ContactLaw law_;
  double margin_ = 0;  // m, as depth_limit, but never less than a step's motion
  SurfaceTopology first_, second_;
  PointContact secondary_points_, primary_points_;
  EdgeContact edges_;
  MotionWatch watch_;
  ContactSprings springs_;
  std::vector<std::int32_t> primary_triangles_;  // those that first_ was made of
  std::vector<Touch> touches_;
  ContactForces forces_;
  std::size_t searches_ = 0;
  double last_step_ = 0;
  bool outdated_ = true;
};

/// Contact of a body with its own surface: of every vertex and particle with the triangles the exclusion leaves it.
class SelfContact {
 public:
  explicit SelfContact(const ContactLaw& law);
  void set_topology(const Body& body);
  /// As PenaltyContact's, the same exclusion until the topology changes. Forces on the body's vertices are in
  /// `secondary`, `primary` is empty.
  const ContactForces& evaluate(const Body& body, const Exclusion& exclusion, double dt);

  void list_state(compute::StateArchive& archive);  ///< as PenaltyContact's

 private:
  POLYNYA_STATE_MEMBERS_WITHOUT((forces_), law_, margin_, topology_, points_, watch_, springs_, touches_, forces_,
                                last_step_, outdated_)
  ContactLaw law_;
  double margin_ = 0;
  SurfaceTopology topology_;
  PointContact points_;
  MotionWatch watch_;
  ContactSprings springs_;
  std::vector<Touch> touches_;
  ContactForces forces_;
  double last_step_ = 0;
  bool outdated_ = true;
};

/// Has the primary surface finer parts than the secondary, so that its vertices could pass between the secondary's? By
/// the length that a tenth of the edges fall below.
bool is_finer(const Body& primary, const Body& secondary);

}  // namespace polynya::contact
